// The temperature of a cell. Where there are several materials, a solid's heat gives its temperature by the curve
// of its own, and takes three registers for a product (docs/automaton.md, section 6). Otherwise it takes none.
//
// A row of `curves` is {heat beyond the temperature when liquid, melting point, warmth}, 49 bits. That of one
// material has no warmth.
module curve_unit #(
    parameter MATERIALS = 0  // bits of their numbers; 0: there is one
) (
    input  logic                       clk,
    input  logic                       en,
    input  logic [15:0]                heat,
    input  logic [3:0]                 material,
    input  logic                       several,
    input  logic [(49<<MATERIALS)-1:0] curves,
    input  logic [15:0]                top,         // no temperature is beyond it
    output logic [15:0]                temperature  // with `several`, that of three moves before
);
  logic [15:0] first;
  temperature_unit of_first (
      .heat(heat), .melting_point(curves[32:17]), .latent_heat(curves[48:33]), .top(top),
      .temperature(first));
  if (MATERIALS != 0) begin : many
    wire [48:0] row = curves[49*material[MATERIALS-1:0]+:49];
    logic [15:0] later0, later3;
    logic signed [34:0] warm3;
    temperature_unit when_liquid (
        .heat(heat), .melting_point(row[32:17]), .latent_heat(row[48:33]), .top(top),
        .temperature(later0));
    product times_warmth (.clk(clk), .en(en), .a($signed({2'b0, heat})), .b(row[16:0]), .p(warm3));
    delay #(.WIDTH(16), .N(3)) waits (.clk(clk), .en(en), .d(later0), .q(later3));
    assign temperature = ~several ? first : warm3[31:16] < later3 ? warm3[31:16] : later3;
  end else begin : one
    assign temperature = first;
  end
endmodule

// What waits for the temperature of a cell.
module curve_wait #(
    parameter WIDTH = 1,
    parameter MATERIALS = 0
) (
    input  logic             clk,
    input  logic             en,
    input  logic             several,
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
  if (MATERIALS != 0) begin : many
    logic [WIDTH-1:0] later;
    delay #(.WIDTH(WIDTH), .N(3)) waits (.clk(clk), .en(en), .d(d), .q(later));
    assign q = several ? later : d;
  end else begin : one
    assign q = d;
  end
endmodule
