// The height of a blocked cell's bed above its lower face, in 1/512 cell (docs/automaton.md, section 10). A
// solid is filled from below, and melted from above as far as its heat says.
module bed_unit (
    input  logic        clk,
    input  logic        en,
    input  logic        solid,         // else inert
    input  logic [15:0] amount,
    input  logic [15:0] heat,
    input  logic        hot,
    input  logic [15:0] liquid_from,
    input  logic [15:0] melt_range,    // constants of the material, which the host computes
    input  logic [1:0]  melt_shift,
    input  logic [13:0] melt_scale,
    output logic [13:0] rise           // 9 moves later
);
  localparam [12:0] MOST = 13'd6143;
  logic [15:0] lack1, lack2;
  logic solid8;
  logic [12:0] filled5;
  logic [13:0] inert8;
  logic signed [34:0] part5, height8;
  wire [15:0] left = heat >= liquid_from ? 16'd0 : liquid_from - heat;
  wire [16:0] over = {1'b0, amount} + 17'd2048;
  product unmelted (.clk(clk), .en(en), .a($signed({4'd0, melt_scale})), .b({1'b0, lack2}), .p(part5));
  wire [12:0] part = hot ? part5[28:16] : 13'd4096;
  product of_it (.clk(clk), .en(en), .a($signed({5'd0, filled5})), .b({4'd0, part}), .p(height8));
  delay #(.WIDTH(13), .N(5)) amounts (
      .clk(clk), .en(en), .d(amount < {3'd0, MOST} ? amount[12:0] : MOST), .q(filled5));
  delay #(.WIDTH(15), .N(8)) waits (.clk(clk), .en(en), .d({solid, over[16:3]}), .q({solid8, inert8}));
  always_ff @(posedge clk)
    if (en) begin
      lack1 <= left < melt_range ? left : melt_range;
      lack2 <= lack1 << melt_shift;
      rise <= solid8 ? {4'd0, height8[24:15]} : inert8;
    end
endmodule
