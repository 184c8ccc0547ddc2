// A division, one bit of the quotient per register. `number` is less than `by` x 2^QUOTIENT. A rest below 0
// lacks the divisor, and gets it with the next bit. So a bit is one sum, without a choice behind it.
module divider #(
    parameter REST = 16,      // bits of the divisor
    parameter QUOTIENT = 16,
    parameter NUMBER = 32     // bits of the number, more than QUOTIENT
) (
    input  logic                     clk,
    input  logic                     en,
    input  logic [NUMBER-1:0]        number,
    input  logic [REST-1:0]          by,
    output logic [QUOTIENT*REST-1:0] divisors,  // 1 .. QUOTIENT moves later
    output logic [QUOTIENT-1:0]      quotient,  // QUOTIENT moves later, as the rest
    output logic signed [REST:0]     rest
);
  logic [QUOTIENT*(REST+1)-1:0] rests /*verilator split_var*/;
  logic [QUOTIENT*QUOTIENT-1:0] lows /*verilator split_var*/;
  for (genvar i = 0; i < QUOTIENT; i++) begin : bits
    localparam BEFORE = i == 0 ? 0 : i - 1;
    wire [REST:0] held = i == 0 ? (REST + 1)'(number[NUMBER-1:QUOTIENT]) : rests[(REST+1)*BEFORE+:REST+1];
    wire [QUOTIENT-1:0] low = i == 0 ? number[QUOTIENT-1:0] : lows[QUOTIENT*BEFORE+:QUOTIENT];
    wire [REST-1:0] divisor = i == 0 ? by : divisors[REST*BEFORE+:REST];
    wire below = held[REST];
    wire [REST+1:0] left = {held[REST-1:0], low[QUOTIENT-1], 1'b0} - {{1'b0, divisor} ^ {(REST + 1) {below}}, below};
    always_ff @(posedge clk)
      if (en) begin
        rests[(REST+1)*i+:REST+1] <= left[REST+1:1];
        lows[QUOTIENT*i+:QUOTIENT] <= {low[QUOTIENT-2:0], ~left[REST+1]};
        divisors[REST*i+:REST] <= divisor;
      end
  end
  assign quotient = lows[QUOTIENT*(QUOTIENT-1)+:QUOTIENT];
  assign rest = rests[(REST+1)*(QUOTIENT-1)+:REST+1];
endmodule
