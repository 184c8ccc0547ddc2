// What pairs of spread move (docs/automaton.md, section 11): every pair gives to one of its cells what it takes from
// the other. Two lanes stand in a ring, so each is the eastern neighbour of the other.
module proof (
    input logic clk,
    input logic [47:0] up_a,
    input logic [47:0] down_a,
    input logic [47:0] x_a,
    input logic [47:0] z_a,
    input logic [47:0] up_b,
    input logic [47:0] down_b,
    input logic [47:0] x_b,
    input logic [47:0] z_b
);
  logic [47:0] here_a, south_a, here_b, south_b;
  spread_sums a (.clk(clk), .move(1'b1), .up22(up_a), .down22(down_a), .along_x22(x_a), .next_up22(up_b),
                 .next_down22(down_b), .next_x22(x_b), .next_z22(z_b), .here25(here_a), .south25(south_a));
  spread_sums b (.clk(clk), .move(1'b1), .up22(up_b), .down22(down_b), .along_x22(x_b), .next_up22(up_a),
                 .next_down22(down_a), .next_x22(x_a), .next_z22(z_a), .here25(here_b), .south25(south_b));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  wire [15:0] amounts = here_a[15:0] + south_a[15:0] + here_b[15:0] + south_b[15:0];
  wire [31:0] contents = here_a[47:16] + south_a[47:16] + here_b[47:16] + south_b[47:16];
  logic [191:0] pairs;
  past #(.WIDTH(192), .N(3)) before (.clk(clk), .d({up_a, x_a, down_b, z_b}), .q(pairs));
  always_comb if (age == 8'd3) begin
    amounts_cancel: assert (amounts == 16'd0);
    contents_cancel: assert (contents == 32'd0);
    here_gets_its_pairs: assert (here_a[15:0] == pairs[159:144] + pairs[63:48] + pairs[15:0]);
  end
endmodule
