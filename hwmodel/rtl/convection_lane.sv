// Convection of one lane: warmer liquid gives heat to colder liquid above it (docs/automaton.md, section 6).
module convection_lane (
    input  logic               clk,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic               on_floor,       // no cell of its column came before it
    input  logic [15:0]        dither5,        // of the step of the cell in register 5
    input  logic [15:0]        melting_point,
    input  logic [15:0]        latent_heat,
    input  logic [15:0]        top,
    input  logic [15:0]        weight,
    output voxmelt_pkg::cell_t cell_out        // 8 moves later
);
  logic [15:0] temperature, warm1, warm2;
  temperature_unit unit (.heat(cell_in.heat), .melting_point(melting_point), .latent_heat(latent_heat),
                         .top(top), .temperature(temperature));
  voxmelt_pkg::cell_t cell1, cell2, cell6, cell7;
  logic floor1;
  logic [15:0] drop2;
  logic signed [34:0] product5;
  logic [15:0] flow6;
  wire rises = ~floor1 & (cell1.state == voxmelt_pkg::LIQUID) & (cell2.state == voxmelt_pkg::LIQUID);
  product times_weight (
      .clk(clk), .en(move), .a($signed({2'b0, drop2})), .b({1'b0, weight}), .p(product5));
  delay #(.WIDTH(67), .N(4)) waits (.clk(clk), .en(move), .d(cell2), .q(cell6));
  wire [34:0] rounded = product5 + 35'(dither5);
  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      warm1 <= temperature;
      floor1 <= on_floor;
      cell2 <= cell1;
      warm2 <= warm1;
      drop2 <= rises & (warm2 > warm1) ? warm2 - warm1 : 16'd0;
      flow6 <= rounded[31:16];
      cell7 <= cell6;
      cell7.heat <= cell6.heat + flow6;
      cell_out <= cell7;
      cell_out.heat <= cell7.heat - flow6;
    end
endmodule
