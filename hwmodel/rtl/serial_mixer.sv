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
  logic [15:0] rest, low;
  logic signed [34:0] part;
  wire [15:0] after = amount + flow;
  wire [15:0] a = count == 5'd0 ? amount : count == 5'd1 ? flow : after;
  wire [15:0] b = count == 5'd0 ? heat : count == 5'd1 ? flow_heat : dither;
  product parts (.clk(clk), .en(1'b1), .a($signed({2'b0, a})), .b({1'b0, b}), .p(part));

  wire [16:0] whole = {rest, low[15]};
  wire fits = whole >= {1'b0, after};
  wire [16:0] less = whole - {1'b0, after};
  assign works = start & (count != DONE);
  assign mixed = low;
  always_ff @(posedge clk) begin
    if (rst | move) count <= 5'd0;
    else if (works) count <= count + 5'd1;
    if (count == 5'd3) content <= part[31:0];
    if (count == 5'd4) content <= content + part[31:0];
    if (count == 5'd5) content <= content + 32'(part[31:16]);
    if (works) begin
      rest <= count == 5'd6 ? content[31:16] : fits ? less[15:0] : whole[15:0];
      low <= count == 5'd6 ? content[15:0] : {low[14:0], fits};
    end
  end
endmodule
