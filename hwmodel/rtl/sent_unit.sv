// One gift on its way: its content, and its energy behind the friction of the reading `printed`.
module sent_unit #(
    parameter PRINTED = 1
) (
    input  logic        clk,
    input  logic        move,
    input  logic [13:0] amount,
    input  logic [13:0] energy,
    input  logic [15:0] heat,
    input  logic [15:0] alpha,
    input  logic        printed,
    output logic [63:0] gift      // 3 moves later
);
  logic [13:0] amount9, energy9, rubbed9;
  logic signed [34:0] content9;
  delay #(.WIDTH(28), .N(3)) waits (.clk(clk), .en(move), .d({amount, energy}), .q({amount9, energy9}));
  product of_heat (.clk(clk), .en(move), .a($signed({4'd0, amount})), .b({1'b0, heat}), .p(content9));
  if (PRINTED != 0) begin : rubs
    logic signed [34:0] friction9;
    product friction (.clk(clk), .en(move), .a($signed({4'd0, energy})), .b({1'b0, alpha}), .p(friction9));
    assign rubbed9 = printed ? friction9[29:16] : energy9;
  end else begin : glides
    assign rubbed9 = energy9;
  end
  assign gift = {2'd0, content9[29:0], 2'd0, rubbed9, 2'd0, amount9};
endmodule
