// What a pair of gravity moves (docs/automaton.md, section 8), from register 7, where the flow of the amounts is known
// and may be any that gravity_amounts proves, to register 12.
module proof (
    input logic clk,
    input logic paper,
    input logic [18:0] beta
);
  logic [15:0] low7, high7, moved9, stays12, flow12, low12, after12, high12;
  logic signed [36:0] gain12;
  voxmelt_pkg::cell_t q, cell12;  // in register 7, as it came, and in register 12
  logic down7, up7, down12, up12;
  gravity_lane dut (
      .clk(clk), .rst(1'b0), .move(1'b1), .cell_in('0), .in_run(1'b0), .first(1'b0), .top(1'b0),
      .live13(1'b0), .dither13(16'd0), .dither18(16'd0), .paper(paper), .hot(1'b0), .printed(1'b0),
      .factor(17'd0), .wall_factor(17'd0), .minimum(16'd0), .hang(16'd0), .beta(beta),
      .cell7(q), .low7(low7), .high7(high7), .down7(down7), .up7(up7), .moved9(moved9), .cell12(cell12),
      .down12(down12), .up12(up12), .stays12(stays12), .flow12(flow12), .low12(low12), .after12(after12),
      .high12(high12), .gain12(gain12));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [18:0] beta1;
  past #(.WIDTH(19), .N(1)) stay (.clk(clk), .d(beta), .q(beta1));
  always_comb if (age != 8'd0) assume (beta == beta1);

  wire [15:0] f = down7 ? q.amount - high7 : up7 ? high7 - q.amount : 16'd0;
  always_comb
    if (age == 8'd0) begin
      assume (~(down7 & up7));
      assume (~down7 | (high7 <= q.amount && 17'(low7) + 17'(f) <= 17'd4096));
      assume (~up7 | (high7 >= q.amount && 17'(f) + 17'd4096 <= 17'(low7)));
      assume (down7 | up7 | high7 == q.amount);
    end

  // What q pays goes with what falls.
  wire [15:0] pays = ~down7 ? 16'd0 : q.energy < f ? q.energy : f;
  logic [15:0] pays2, pays5, f5, low5, high5;
  logic down5, up5;
  voxmelt_pkg::cell_t q5;
  past #(.WIDTH(16), .N(2)) paying (.clk(clk), .d(pays), .q(pays2));
  past #(.WIDTH(133), .N(5)) later (
      .clk(clk), .d({pays, f, low7, high7, down7, up7, q}), .q({pays5, f5, low5, high5, down5, up5, q5}));
  always_comb if (age == 8'd2) begin
    pays_as_the_page: assert (moved9 == pays2);
  end
  logic signed [36:0] gain, gain3;
  assign gain = 37'($signed({2'b0, moved9}) * $signed({1'b0, beta}));
  past #(.WIDTH(37), .N(3)) gains (.clk(clk), .d(gain), .q(gain3));
  wire [15:0] after = up5 ? low5 - f5 : low5 + f5;
  always_comb if (age == 8'd5) begin
    gain_as_the_page: assert (gain12 == gain3);
    flow_goes_along: assert (flow12 == f5 && low12 == low5 && high12 == high5 && after12 == after && cell12 == q5 &&
                             down12 == down5 && up12 == up5);
    rest_stays: assert (stays12 == q5.energy - pays5);
  end
endmodule
