// Random bits: the block cipher Speck64/128 cut to 10 rounds, a round per register (docs/automaton.md,
// section 5).
module speck_unit (
    input  logic         clk,
    input  logic         move,
    input  logic [319:0] keys,
    input  logic [31:0]  step,
    input  logic [31:0]  index,
    output logic [63:0]  block   // 10 moves later
);
  logic [10*32-1:0] high /*verilator split_var*/, low /*verilator split_var*/;  // after so many rounds
  for (genvar round = 0; round < 10; round++) begin : rounds
    localparam BEFORE = round == 0 ? 0 : round - 1;
    wire [31:0] h = round == 0 ? step : high[32*BEFORE+:32];
    wire [31:0] l = round == 0 ? index : low[32*BEFORE+:32];
    wire [31:0] next_high = ({h[7:0], h[31:8]} + l) ^ keys[32*round+:32];
    always_ff @(posedge clk)
      if (move) begin
        high[32*round+:32] <= next_high;
        low[32*round+:32] <= {l[28:0], l[31:29]} ^ next_high;
      end
  end
  assign block = {high[9*32+:32], low[9*32+:32]};
endmodule
