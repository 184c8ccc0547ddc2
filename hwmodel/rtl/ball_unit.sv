// Is the centre of a cell in a ball? Numbers are in sixteenths of a cell.
module ball_unit (
    input  logic        clk,
    input  logic        move,
    input  logic [11:0] x,
    input  logic [11:0] y,
    input  logic [11:0] z,
    input  logic signed [17:0] at_x,
    input  logic signed [17:0] at_y,
    input  logic signed [17:0] at_z,
    input  logic [35:0] radius2,
    output logic        inside_ball    // 7 moves later
);
  function automatic [17:0] apart(input [11:0] place, input signed [17:0] centre);
    apart = $signed({2'd0, place, 4'd8}) - centre;
  endfunction
  logic signed [17:0] x1, y1, z1;
  logic [16:0] x2, y2, z2;
  logic signed [34:0] x5, y5, z5;
  logic [35:0] flat6, along6;
  product along_x (.clk(clk), .en(move), .a($signed({1'b0, x2})), .b(x2), .p(x5));
  product along_y (.clk(clk), .en(move), .a($signed({1'b0, y2})), .b(y2), .p(y5));
  product along_z (.clk(clk), .en(move), .a($signed({1'b0, z2})), .b(z2), .p(z5));
  always_ff @(posedge clk)
    if (move) begin
      x1 <= $signed(apart(x, at_x));
      y1 <= $signed(apart(y, at_y));
      z1 <= $signed(apart(z, at_z));
      x2 <= x1[17] ? 17'(-x1) : x1[16:0];
      y2 <= y1[17] ? 17'(-y1) : y1[16:0];
      z2 <= z1[17] ? 17'(-z1) : z1[16:0];
      flat6 <= 36'(y5) + 36'(z5);
      along6 <= 36'(x5);
      inside_ball <= (37'(flat6) + 37'(along6)) <= 37'(radius2);
    end
endmodule
