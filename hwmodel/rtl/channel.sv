// A bounded stream of words: what the producer puts, the consumer may get in the next cycle.
module channel #(
    parameter WIDTH = 1,
    parameter DEPTH = 4
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_word,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_word
);
  localparam COUNT = $clog2(DEPTH + 1), ADDRESS = DEPTH > 1 ? $clog2(DEPTH) : 1;
  logic [WIDTH-1:0] words[0:DEPTH-1];
  logic [ADDRESS-1:0] head, tail;
  logic [COUNT-1:0] count;
  assign in_ready = count != COUNT'(DEPTH);
  assign out_valid = count != '0;
  assign out_word = words[head];
  wire put = in_valid & in_ready, get = out_valid & out_ready;

  always_ff @(posedge clk)
    if (rst) begin
      head <= '0;
      tail <= '0;
      count <= '0;
    end else begin
      if (put) tail <= tail == ADDRESS'(DEPTH - 1) ? '0 : tail + ADDRESS'(1);
      if (get) head <= head == ADDRESS'(DEPTH - 1) ? '0 : head + ADDRESS'(1);
      count <= count + COUNT'(put) - COUNT'(get);
    end
  always_ff @(posedge clk) if (put) words[tail] <= in_word;
endmodule
