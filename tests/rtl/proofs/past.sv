// What a word was N moves before. It is no part of the design.
module past #(
    parameter WIDTH = 1,
    parameter N = 1
) (
    input  logic             clk,
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
  logic [N*WIDTH-1:0] words;
  assign q = words[(N-1)*WIDTH+:WIDTH];
  if (N == 1) begin : one
    always_ff @(posedge clk) words <= d;
  end else begin : more
    always_ff @(posedge clk) words <= {words[0+:(N-1)*WIDTH], d};
  end
endmodule

// How many moves have been made, up to 255. All other registers may begin with any value.
module moves (
    input  logic       clk,
    output logic [7:0] age
);
  initial age = 8'd0;
  always_ff @(posedge clk) if (age != 8'd255) age <= age + 8'd1;
endmodule
