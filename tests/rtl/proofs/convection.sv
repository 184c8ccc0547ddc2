// Heat that rises in liquid (docs/automaton.md, section 6, rule 2). The lower cell p came a move before q.
module proof (
    input logic clk,
    input voxmelt_pkg::cell_t cell_in,
    input logic on_floor,
    input logic [15:0] dither5,
    input logic [15:0] melting_point,
    input logic [15:0] latent_heat,
    input logic [15:0] top,
    input logic [15:0] weight
);
  voxmelt_pkg::cell_t cell_out;
  logic [15:0] temperature, drop2;
  convection_lane dut (
      .clk(clk), .move(1'b1), .cell_in(cell_in), .on_floor(on_floor), .dither5(dither5),
      .melting_point(melting_point), .latent_heat(latent_heat), .top(top), .weight(weight), .cell_out(cell_out),
      .temperature(temperature), .drop2(drop2));
  logic [7:0] age;
  moves count (.clk(clk), .age(age));
  logic [63:0] numbers, numbers1;
  assign numbers = {melting_point, latent_heat, top, weight};
  past #(.WIDTH(64), .N(1)) stay (.clk(clk), .d(numbers), .q(numbers1));
  always_comb if (age != 8'd0) assume (numbers == numbers1);

  // Section 6: T(h) = h up to Tm, and max(Tm, h - L) above.
  wire [15:0] h = cell_in.heat;
  wire [15:0] above_latent = h > latent_heat ? h - latent_heat : 16'd0;
  wire [15:0] warm = h <= melting_point ? h : above_latent > melting_point ? above_latent : melting_point;
  wire [15:0] t = warm < top ? warm : top;

  voxmelt_pkg::cell_t p, q8;
  logic [15:0] warm_p, flow6, flow7;
  past #(.WIDTH(83), .N(1)) lower (.clk(clk), .d({cell_in, t}), .q({p, warm_p}));
  wire rises = ~on_floor & p.state == voxmelt_pkg::LIQUID & cell_in.state == voxmelt_pkg::LIQUID & warm_p > t;
  logic [15:0] due2;
  past #(.WIDTH(16), .N(2)) drop_of_pair (.clk(clk), .d(rises ? warm_p - t : 16'd0), .q(due2));
  always_comb if (age == 8'd3) begin
    drop_as_the_page: assert (drop2 == due2);
  end
  logic signed [34:0] part, part5;
  assign part = 35'($signed({2'b0, drop2}) * $signed({1'b0, 1'b0, weight}));
  past #(.WIDTH(35), .N(3)) parts (.clk(clk), .d(part), .q(part5));
  wire [34:0] sum5 = part5 + 35'(dither5);
  // What q gets from p, and a move later what q gives to the cell above it.
  past #(.WIDTH(16), .N(3)) gain (.clk(clk), .d(sum5[31:16]), .q(flow7));
  past #(.WIDTH(16), .N(2)) loss (.clk(clk), .d(sum5[31:16]), .q(flow6));
  past #(.WIDTH(67), .N(8)) waits (.clk(clk), .d(cell_in), .q(q8));
  always_comb if (age == 8'd0) begin
    temperature_as_the_page: assert (temperature == t);
  end
  always_comb if (age == 8'd9) begin
    heat_as_the_page: assert (cell_out.heat == q8.heat + flow7 - flow6);
    all_else_stays: assert (cell_out.amount == q8.amount && cell_out.energy == q8.energy &&
                            cell_out.state == q8.state);
  end
endmodule
