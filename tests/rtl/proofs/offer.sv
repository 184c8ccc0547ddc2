// Who may give to whom in spread (docs/automaton.md, section 9), for one window.
module proof (
    input logic clk,
    input logic [48:0] here,
    input logic [48:0] west,
    input logic [48:0] south,
    input logic [48:0] south_west,
    input logic has_west,
    input logic has_south,
    input logic eight
);
  logic here_south, south_north, south_goes_west, south_west_east, here_south_west, south_west_north_east,
        west_south_east, south_north_west;
  offer_unit dut (
      .here(here), .west(west), .south(south), .south_west(south_west), .has_west(has_west), .has_south(has_south),
      .eight(eight), .here_south(here_south), .south_north(south_north), .south_goes_west(south_goes_west),
      .south_west_east(south_west_east), .here_south_west(here_south_west),
      .south_west_north_east(south_west_north_east), .west_south_east(west_south_east),
      .south_north_west(south_north_west));
  wire to_here = south_north | south_west_north_east, to_west = south_north_west;
  wire to_south = here_south | south_west_east | west_south_east, to_south_west = south_goes_west | here_south_west;
  wire diagonal = here_south_west | south_west_north_east, other = west_south_east | south_north_west;
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  always_comb if (age == 8'd0) begin
    blocked_gets_nothing: assert (~(here[0] & to_here) & ~(west[0] & to_west) & ~(south[0] & to_south) &
                                  ~(south_west[0] & to_south_west));
    only_below_the_limit: assert ((~here_south | south[16:1] < here[32:17]) &
                                  (~here_south_west | south_west[16:1] < here[48:33]) &
                                  (~west_south_east | south[16:1] < west[48:33]));
    not_through_a_corner: assert (~(diagonal & west[0] & south[0]) & ~(other & here[0] & south_west[0]));
    not_across_the_border: assert ((has_south | ~(here_south | south_north | diagonal | other)) &
                                   (has_west | ~(south_goes_west | south_west_east | diagonal | other)));
    four_without_corners: assert (eight | ~(diagonal | other));
  end
endmodule
