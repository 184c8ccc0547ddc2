// Delays a word by so many moves: a memory with one read and one write a cycle, and its output register.
module line_memory #(
    parameter WIDTH = 1,
    parameter DEPTH = 4096  // the longest delay, less one
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             en,
    input  logic [23:0]      delay,  // 2..DEPTH + 1
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
  localparam ADDRESS = DEPTH > 1 ? $clog2(DEPTH) : 1;
  logic [WIDTH-1:0] words[0:DEPTH-1];
  logic [ADDRESS-1:0] at;
  wire [23:0] last = delay - 24'd2;

  always_ff @(posedge clk)
    if (rst) at <= '0;
    else if (en) at <= at == ADDRESS'(last) ? '0 : at + ADDRESS'(1);

  always_ff @(posedge clk)
    if (en) begin
      q <= words[at];
      words[at] <= d;
    end
endmodule
