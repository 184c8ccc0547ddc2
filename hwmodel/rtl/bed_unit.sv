// The height of a blocked cell's bed above its lower face, in 1/512 cell (docs/automaton.md, section 10). A
// solid is filled from below, and melted from above as far as its heat says.
//
// A row of `beds` has constants of a material, which the host computes: {scale, shift, range of heat in which it
// melts, heat from which on it is liquid}, 48 bits.
module bed_unit #(
    parameter MATERIALS = 0
) (
    input  logic        clk,
    input  logic        en,
    input  logic        solid,         // else inert
    input  logic [15:0] amount,
    input  logic [15:0] heat,
    input  logic [3:0]  material,
    input  logic        hot,
    input  logic [(48<<MATERIALS)-1:0] beds,
    output logic [13:0] rise           // 9 moves later
);
  localparam [12:0] MOST = 13'd6143;
  logic [47:0] row;
  logic [1:0] shift1;
  logic [13:0] scale2;
  if (MATERIALS != 0) begin : many
    logic [13:0] scale1;
    assign row = beds[48*material[MATERIALS-1:0]+:48];
    always_ff @(posedge clk)
      if (en) begin
        shift1 <= row[33:32];
        scale1 <= row[47:34];
        scale2 <= scale1;
      end
  end else begin : one
    assign row = beds;
    assign shift1 = beds[33:32];
    assign scale2 = beds[47:34];
  end
  logic [15:0] lack1, lack2;
  logic solid8;
  logic [12:0] filled5;
  logic [13:0] inert8;
  logic signed [34:0] part5, height8;
  wire [15:0] left = heat >= row[15:0] ? 16'd0 : row[15:0] - heat;
  wire [16:0] over = {1'b0, amount} + 17'd2048;
  product unmelted (.clk(clk), .en(en), .a($signed({4'd0, scale2})), .b({1'b0, lack2}), .p(part5));
  wire [12:0] part = hot ? part5[28:16] : 13'd4096;
  product of_it (.clk(clk), .en(en), .a($signed({5'd0, filled5})), .b({4'd0, part}), .p(height8));
  delay #(.WIDTH(13), .N(5)) amounts (
      .clk(clk), .en(en), .d(amount < {3'd0, MOST} ? amount[12:0] : MOST), .q(filled5));
  delay #(.WIDTH(15), .N(8)) waits (.clk(clk), .en(en), .d({solid, over[16:3]}), .q({solid8, inert8}));
  always_ff @(posedge clk)
    if (en) begin
      lack1 <= left < row[31:16] ? left : row[31:16];
      lack2 <= lack1 << shift1;
      rise <= solid8 ? {4'd0, height8[24:15]} : inert8;
    end
endmodule
