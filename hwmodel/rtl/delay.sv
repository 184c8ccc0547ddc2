// Delays a word by N moves, in registers.
module delay #(
    parameter WIDTH = 1,
    parameter N = 1
) (
    input  logic             clk,
    input  logic             en,
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
  logic [N*WIDTH-1:0] words;
  assign q = words[(N-1)*WIDTH+:WIDTH];
  if (N == 1) begin : one
    always_ff @(posedge clk) if (en) words <= d;
  end else begin : more
    always_ff @(posedge clk) if (en) words <= {words[0+:(N-1)*WIDTH], d};
  end
endmodule
