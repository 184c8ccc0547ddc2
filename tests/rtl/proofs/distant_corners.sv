// What the cells of a window get across corners (docs/automaton.md, section 6, rule 1). The pairs stand in
// the order of that page, which gives the dither.
module proof (
    input logic clk,
    input logic west_there,
    input logic below_there,
    input logic south_there,
    input logic [21:0] here,
    input logic [21:0] west,
    input logic [21:0] below,
    input logic [21:0] west_below,
    input logic [21:0] south,
    input logic [21:0] south_west,
    input logic [21:0] south_below,
    input logic [21:0] south_west_below,
    input logic [15:0] weight,
    input logic [15:0] dither5
);
  localparam PAIRS = 4;
  logic [PAIRS*18-1:0] drops2;
  logic [PAIRS*16-1:0] flows6;
  logic [15:0] here7, west7, below7, west_below7, south7, south_west7, south_below7, south_west_below7;
  distant_lane dut (
      .clk(clk), .move(1'b1), .west_there(west_there), .below_there(below_there), .south_there(south_there),
      .here(here), .west(west), .below(below), .west_below(west_below), .south(south), .south_west(south_west),
      .south_below(south_below), .south_west_below(south_west_below), .weights(weight), .dither5(dither5),
      .here7(here7), .west7(west7), .below7(below7), .west_below7(west_below7), .south7(south7),
      .south_west7(south_west7), .south_below7(south_below7), .south_west_below7(south_west_below7),
      .drops2(drops2), .flows6(flows6));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));

  function automatic signed [17:0] drop(input there, input [21:0] p, input [21:0] q);
    drop = there & p[16] & q[16] ? $signed({2'b0, q[15:0]}) - $signed({2'b0, p[15:0]}) : 18'sd0;
  endfunction
  logic [PAIRS*18-1:0] due2;
  past #(.WIDTH(PAIRS * 18), .N(1)) drops (
      .clk(clk),
      .d({drop(west_there & below_there & south_there, west, south_below), drop(west_there & below_there & south_there, south_west, below),
          drop(west_there & below_there & south_there, west_below, south), drop(west_there & below_there & south_there, south_west_below, here)}),
      .q(due2));
  logic [PAIRS*16-1:0] due6;
  for (genvar pair = 0; pair < PAIRS; pair++) begin
    logic signed [34:0] product5, rounded6;
    past #(.WIDTH(35), .N(3)) products (
        .clk(clk), .d(35'($signed(drops2[pair*18+:18]) * $signed({1'b0, 1'b0, weight}))), .q(product5));
    past #(.WIDTH(35), .N(1)) rounded (
        .clk(clk), .d(35'(product5 + $signed({19'd0, 16'(dither5 + 16'(65536 * pair / PAIRS))})) >>> 16),
        .q(rounded6));
    assign due6[pair*16+:16] = rounded6[15:0];
  end
  logic [PAIRS*16-1:0] flows7;
  past #(.WIDTH(PAIRS * 16), .N(1)) later (.clk(clk), .d(flows6), .q(flows7));
  wire [15:0] all7 = here7 + west7 + below7 + west_below7 + south7 + south_west7 + south_below7 +
                     south_west_below7;
  always_comb if (age == 8'd1) begin
    pairs_as_the_page: assert (drops2 == due2);
    nothing_lost: assert (all7 == 16'd0);
    each_gets_its_own: assert (south_west_below7 == 16'd0 + flows7[0+:16] &&
        here7 == 16'd0 - flows7[0+:16] &&
        west_below7 == 16'd0 + flows7[16+:16] &&
        south7 == 16'd0 - flows7[16+:16] &&
        south_west7 == 16'd0 + flows7[32+:16] &&
        below7 == 16'd0 - flows7[32+:16] &&
        west7 == 16'd0 + flows7[48+:16] &&
        south_below7 == 16'd0 - flows7[48+:16]);
  end
  always_comb if (age == 8'd6) begin
    flows_as_the_page: assert (flows6 == due6);
  end
endmodule
