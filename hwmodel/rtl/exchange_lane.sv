// Exchange of one lane: radiation, then air, then what the cell glows (docs/automaton.md, section 6). A
// weight of 0 exchanges nothing. Where there are materials, a cell waits for its temperature before each of the
// last two, and registers are named without that.
module exchange_lane #(
    parameter MATERIALS = 0
) (
    input  logic               clk,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic [15:0]        received,       // irradiance, 1/16 of a temperature unit per step
    input  logic [15:0]        dither1,        // these belong to the cell in the register of their number
    input  logic [15:0]        dither7,
    input  logic [15:0]        dither20,
    input  logic [15:0]        ambient3,
    input  logic               several,
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]        top,
    input  logic [(48<<MATERIALS)-1:0] air_weights,  // with one, two and three exposed axes
    input  logic [47:0]        glow_weights,
    input  logic [15:0]        sky,            // the fourth power of its temperature
    output voxmelt_pkg::cell_t cell_out        // 22 moves later, and 6 more with materials
);
  voxmelt_pkg::cell_t cell1, cell2, cell2_warm, cell8, cell9, cell9_warm, cell21;
  logic [15:0] received1, warm3, warm10;
  logic [15:0] weight2, weight2_warm, weight9, weight9_warm, air4, glow17;
  logic signed [17:0] excess4, excess17, flow8, flow21;
  logic signed [34:0] product7, square13, fourth16, product20;

  wire [28:0] radiated = {1'b0, received1, 12'd0} + 29'(dither1);
  wire [16:0] lit = 17'(cell1.heat) + 17'(radiated[28:16]);
  wire [1:0] axes1 = cell1.exposed_axes;  // only matter has any
  logic [3:0] material1, material2, material9;
  logic [47:0] air1;
  if (MATERIALS != 0) begin : many
    material_of number (.stored({cell1.heat, cell1.energy, cell1.amount, cell1.state}), .material(material1));
    always_ff @(posedge clk) if (move) material2 <= material1;
    material_of later (.stored({cell9.heat, cell9.energy, cell9.amount, cell9.state}), .material(material9));
    assign air1 = air_weights[48*material1[MATERIALS-1:0]+:48];
  end else begin : one
    assign {material1, material2, material9} = 12'd0;
    assign air1 = air_weights;
  end
  wire [15:0] weight1 = axes1 == 2'd3 ? air1[47:32] : axes1 == 2'd2 ? air1[31:16]
                      : axes1 == 2'd1 ? air1[15:0] : 16'd0;
  wire [1:0] axes8 = cell8.exposed_axes;
  wire [15:0] weight8 = axes8 == 2'd3 ? glow_weights[47:32] : axes8 == 2'd2 ? glow_weights[31:16]
                      : axes8 == 2'd1 ? glow_weights[15:0] : 16'd0;

  logic [15:0] temperature2, temperature9;
  curve_unit #(.MATERIALS(MATERIALS)) before_air (
      .clk(clk), .en(move), .heat(cell2.heat), .material(material2), .several(several), .curves(curves), .top(top),
      .temperature(temperature2));
  curve_unit #(.MATERIALS(MATERIALS)) after_air (
      .clk(clk), .en(move), .heat(cell9.heat), .material(material9), .several(several), .curves(curves), .top(top),
      .temperature(temperature9));
  curve_wait #(.WIDTH(83), .MATERIALS(MATERIALS)) air_waits (
      .clk(clk), .en(move), .several(several), .d({weight2, cell2}), .q({weight2_warm, cell2_warm}));
  curve_wait #(.WIDTH(83), .MATERIALS(MATERIALS)) glow_waits_for_it (
      .clk(clk), .en(move), .several(several), .d({weight9, cell9}), .q({weight9_warm, cell9_warm}));
  product of_air (.clk(clk), .en(move), .a(excess4), .b({1'b0, air4}), .p(product7));
  product square (.clk(clk), .en(move), .a($signed({2'b0, warm10})), .b({1'b0, warm10}), .p(square13));
  product fourth (.clk(clk), .en(move), .a($signed({2'b0, square13[31:16]})), .b({1'b0, square13[31:16]}),
                  .p(fourth16));
  product of_glow (.clk(clk), .en(move), .a(excess17), .b({1'b0, glow17}), .p(product20));

  logic [15:0] weight3, weight16;
  delay #(.WIDTH(16), .N(1)) weight_waits (.clk(clk), .en(move), .d(weight2_warm), .q(weight3));
  delay #(.WIDTH(16), .N(7)) glow_waits (.clk(clk), .en(move), .d(weight9_warm), .q(weight16));
  delay #(.WIDTH(67), .N(6)) waits_for_air (.clk(clk), .en(move), .d(cell2_warm), .q(cell8));
  delay #(.WIDTH(67), .N(12)) waits_for_glow (.clk(clk), .en(move), .d(cell9_warm), .q(cell21));

  wire signed [34:0] rounded7 = product7 + $signed({19'd0, dither7});
  wire signed [34:0] rounded20 = product20 + $signed({19'd0, dither20});
  wire signed [18:0] raised8 = $signed({3'd0, cell8.heat}) + 19'(flow8);
  wire signed [18:0] raised21 = $signed({3'd0, cell21.heat}) + 19'(flow21);
  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      received1 <= received;  // a solid's alone counts

      cell2 <= cell1;
      if (cell1.state == voxmelt_pkg::SOLID) cell2.heat <= lit[16] ? 16'hFFFF : lit[15:0];
      weight2 <= weight1;
      warm3 <= temperature2;
      excess4 <= $signed({2'b0, ambient3}) - $signed({2'b0, warm3});
      air4 <= weight3;
      flow8 <= 18'(rounded7 >>> 16);

      cell9 <= cell8;
      cell9.heat <= raised8 > 19'sd65535 ? 16'hFFFF : raised8[15:0];
      weight9 <= weight8;
      warm10 <= temperature9;
      excess17 <= $signed({2'b0, sky}) - $signed({2'b0, fourth16[31:16]});
      glow17 <= weight16;
      flow21 <= 18'(rounded20 >>> 16);

      cell_out <= cell21;
      cell_out.heat <= raised21 > 19'sd65535 ? 16'hFFFF : raised21[15:0];
      cell_out.exposed_axes <= 2'd0;
    end
endmodule
