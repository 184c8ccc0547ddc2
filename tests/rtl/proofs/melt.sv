// Melting, freezing and reheating (docs/automaton.md, section 7), without materials.
module proof (
    input logic clk,
    input voxmelt_pkg::cell_t cell_in,
    input logic paper,
    input logic [15:0] freezes_below,
    input logic [15:0] liquid_from,
    input logic [15:0] reheat
);
  voxmelt_pkg::cell_t cell_out, c;
  melt_lane dut (.clk(clk), .move(1'b1), .cell_in(cell_in), .paper(paper), .freezes_below(freezes_below),
                 .melting({17'd0, liquid_from}), .reheat(reheat), .cell_out(cell_out));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [48:0] numbers, numbers1;
  assign numbers = {paper, freezes_below, liquid_from, reheat};
  past #(.WIDTH(49), .N(1)) stay (.clk(clk), .d(numbers), .q(numbers1));
  always_comb if (age != 8'd0) assume (numbers == numbers1);

  wire [15:0] lacks = cell_in.amount - cell_in.energy;
  logic signed [34:0] part, part5;
  assign part = 35'($signed({2'b0, lacks}) * $signed({1'b0, 1'b0, reheat}));
  past #(.WIDTH(35), .N(5)) parts (.clk(clk), .d(part), .q(part5));
  past #(.WIDTH(67), .N(5)) comes (.clk(clk), .d(cell_in), .q(c));
  always_comb if (age == 8'd5) begin
    assume (c.energy <= c.amount);
    assume (paper | c.energy == 16'd0);
    assume (paper | reheat == 16'd0);
    assume (freezes_below <= liquid_from);  // freezing_point <= Tm
  end
  wire liquid = c.state == voxmelt_pkg::LIQUID, hot = c.heat >= liquid_from;
  wire cold = liquid & c.heat < freezes_below;
  wire freezes = cold & c.amount >= 16'd4032 & c.touches;
  wire melts = hot & c.state == voxmelt_pkg::SOLID;
  wire [1:0] state = freezes ? voxmelt_pkg::SOLID : melts ? voxmelt_pkg::LIQUID : c.state;
  wire [15:0] energy = freezes ? 16'd0 : melts & paper ? c.amount : liquid & hot ? c.energy + part5[31:16] : c.energy;
  always_comb if (age == 8'd5) begin
    state_as_the_page: assert (cell_out.state == state);
    energy_as_the_page: assert (cell_out.energy == energy);
    set_as_the_page: assert (cell_out.is_set == (cold & ~freezes));
    amount_and_heat_stay: assert (cell_out.amount == c.amount && cell_out.heat == c.heat);
    energy_is_no_more_than_the_amount: assert (cell_out.energy <= c.amount);
  end
endmodule
