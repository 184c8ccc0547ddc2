// Heat of a mixture, one bit of the quotient a cycle (docs/automaton.md, section 4). It works while `start`
// holds and nothing else moves. So its operands stay as they are.
module serial_mixer (
    input  logic        clk,
    input  logic        rst,
    input  logic        start,
    input  logic        move,        // ends it, when it has done
    input  logic [15:0] amount,      // of the one part and its heat
    input  logic [15:0] heat,
    input  logic [15:0] flow,        // of the other
    input  logic [15:0] flow_heat,
    input  logic [15:0] dither,
    output logic        works,
    output logic [15:0] mixed
);
  localparam [4:0] DONE = 5'd23;
  logic [4:0] count;
  logic [31:0] content;
  logic [16:0] rest;  // as in the mixer
  logic [15:0] low, a, b, after;
  logic signed [34:0] part;
  product parts (.clk(clk), .en(1'b1), .a($signed({2'b0, a})), .b({1'b0, b}), .p(part));

  wire [31:0] number = content + 32'(part[31:16]);
  wire below = rest[16];
  wire [17:0] left = {rest[15:0], low[15], 1'b0} - {{1'b0, after} ^ {17{below}}, below};
  assign works = start & (count != DONE);
  assign mixed = low;
  always_ff @(posedge clk) begin
    if (rst | move) count <= 5'd0;
    else if (works) count <= count + 5'd1;
    after <= amount + flow;
    a <= count == 5'd0 ? amount : count == 5'd1 ? flow : after;
    b <= count == 5'd0 ? heat : count == 5'd1 ? flow_heat : dither;
    if (count == 5'd4) content <= part[31:0];
    if (count == 5'd5) content <= content + part[31:0];
    if (works) begin
      rest <= count == 5'd6 ? {1'b0, number[31:16]} : left[17:1];
      low <= count == 5'd6 ? number[15:0] : {low[14:0], ~left[17]};
    end
  end
endmodule
