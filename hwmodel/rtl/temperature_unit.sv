// The temperature that a heat gives. Between the melting point and `latent_heat` above it, heat only melts
// (docs/automaton.md, section 6).
module temperature_unit (
    input  logic [15:0] heat,
    input  logic [15:0] melting_point,
    input  logic [15:0] latent_heat,
    output logic [15:0] temperature
);
  wire signed [16:0] later = $signed({1'b0, heat}) - $signed({1'b0, latent_heat});
  wire melted = later > $signed({1'b0, melting_point});
  assign temperature = heat < melting_point ? heat : melted ? later[15:0] : melting_point;
endmodule
