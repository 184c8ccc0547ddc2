// Finishes a cell whose pairs are all done: its amount, and the heat of the mixture (docs/automaton.md, section
// 11). Numbers are positions of the stage spread.
module spread_finish #(
    parameter MATERIALS = 0
) (
    input  logic               clk,
    input  logic               move,
    input  logic [35:0]        word23,      // {heat, amount, beside a wall, set, ground}
    input  logic [3:0]         material23,  // of a solid
    input  logic [15:0]        amount26,    // what it got
    input  logic [31:0]        content26,
    input  logic [15:0]        dither27,    // of its pass
    input  logic               hot,
    input  logic               finds_walls,
    output voxmelt_pkg::cell_t cell_out,    // 25 moves after the word, as the bit below
    output logic               in_run
);
  localparam [1:0] RUN = 2'd1;
  logic [35:0] word26, word27, word47;
  logic [15:0] present27, mixed47;
  logic [31:0] content27;
  logic signed [34:0] held26;
  wire blocked47 = word47[1], empty47 = word47[19:4] == 16'd0;
  product held (.clk(clk), .en(move), .a($signed({2'b0, word23[19:4]})), .b({1'b0, word23[35:20]}), .p(held26));
  delay #(.WIDTH(36), .N(3)) waits (.clk(clk), .en(move), .d(word23), .q(word26));
  delay #(.WIDTH(36), .N(20)) mixes (
      .clk(clk), .en(move), .d({word27[35:20], word27[1] ? word27[19:4] : present27, word27[3:0]}), .q(word47));
  logic [3:0] material47;
  if (MATERIALS != 0) begin : many
    delay #(.WIDTH(4), .N(24)) numbers (.clk(clk), .en(move), .d(material23), .q(material47));
  end else begin : one
    assign material47 = 4'd0;
  end
  mixer mixture (.clk(clk), .en(move), .content(content27), .amount(present27), .dither(dither27), .heat(mixed47));
  always_ff @(posedge clk)
    if (move) begin
      word27 <= word26;
      present27 <= word26[19:4] + amount26;
      content27 <= held26[31:0] + content26;
      cell_out <= '0;
      cell_out.amount <= word47[19:4];
      cell_out.heat <= blocked47 ? word47[35:20] : empty47 | ~hot ? 16'd0 : mixed47;
      cell_out.state <= blocked47 ? word47[1:0] : empty47 ? voxmelt_pkg::AIR : voxmelt_pkg::LIQUID;
      cell_out.beside_wall <= finds_walls & ~blocked47 & word47[3];
      cell_out.energy <= {12'd0, material47};
      cell_out.is_set <= ~blocked47 & word47[2];
      in_run <= word47[1:0] == RUN;
    end
endmodule
