// The number of the time step of the pass whose first token comes next. Each pass has STEPS of them.
module pass_step #(
    parameter TOKENS = 1,
    parameter STEPS = 1
) (
    input  logic        clk,
    input  logic        rst,
    input  logic [31:0] first_step,
    input  logic        takes,       // a token
    output logic [31:0] step
);
  localparam [31:0] LAST = TOKENS - 1;
  logic [31:0] taken;
  always_ff @(posedge clk)
    if (rst) begin
      taken <= 32'd0;
      step <= first_step;
    end else if (takes) begin
      taken <= taken == LAST ? 32'd0 : taken + 32'd1;
      if (taken == LAST) step <= step + STEPS;
    end
endmodule
