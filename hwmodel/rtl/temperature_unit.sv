// The temperature that a heat gives. Between the melting point and `latent_heat` above it, heat only melts
// (docs/automaton.md, section 6). Each value is compared with the greatest one beside the others, not behind them.
module temperature_unit (
    input  logic [15:0] heat,
    input  logic [15:0] melting_point,
    input  logic [15:0] latent_heat,
    input  logic [15:0] top,         // no temperature is beyond it; 65535 where there is one material
    output logic [15:0] temperature
);
  wire signed [16:0] later = $signed({1'b0, heat}) - $signed({1'b0, latent_heat});
  wire melted = later > $signed({1'b0, melting_point});
  wire [15:0] of_liquid = later > $signed({1'b0, top}) ? top : later[15:0];
  wire [15:0] of_solid = heat > top ? top : heat;
  wire [15:0] between = melting_point > top ? top : melting_point;
  assign temperature = heat < melting_point ? of_solid : melted ? of_liquid : between;
endmodule
