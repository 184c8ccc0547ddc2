// Delays a word by N moves, in registers. A simulator moves a pointer instead of N words, which is the same to
// whoever stands outside (proved: tests/rtl/proofs/delay.sv).
module delay #(
    parameter WIDTH = 1,
    parameter N = 1
) (
    input  logic             clk,
    input  logic             en,
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
`ifdef VERILATOR
  localparam POINTS = N > 2;
`else
  localparam POINTS = 0;
`endif
  if (N == 1) begin : one
    always_ff @(posedge clk) if (en) q <= d;
  end else if (POINTS == 0) begin : more
    logic [N*WIDTH-1:0] words;
    assign q = words[(N-1)*WIDTH+:WIDTH];
    always_ff @(posedge clk) if (en) words <= {words[0+:(N-1)*WIDTH], d};
  end else begin : points
    delay_ring #(.WIDTH(WIDTH), .N(N)) ring (.clk(clk), .en(en), .d(d), .q(q));
  end
endmodule

// The same for a simulator: where the oldest of N words stands, the next one is written.
module delay_ring #(
    parameter WIDTH = 1,
    parameter N = 3
) (
    input  logic             clk,
    input  logic             en,
    input  logic [WIDTH-1:0] d,
    output logic [WIDTH-1:0] q
);
  logic [WIDTH-1:0] words[N];
  localparam BITS = $clog2(N);
  logic [BITS-1:0] oldest;
  initial oldest = '0;
  assign q = words[oldest];
  always_ff @(posedge clk)
    if (en) begin
      words[oldest] <= d;
      oldest <= oldest == BITS'(N - 1) ? '0 : oldest + BITS'(1);
    end
endmodule
