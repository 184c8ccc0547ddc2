// The bits of a step's number in reverse. They round up as often as they should (docs/automaton.md, section 4).
module dither_unit (
    input  logic [31:0] step,
    output logic [15:0] dither
);
  for (genvar i = 0; i < 16; i++) begin : bits
    assign dither[i] = step[15-i];
  end
endmodule
