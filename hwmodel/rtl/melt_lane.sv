// Melting, freezing and reheating of one lane (docs/automaton.md, section 7). What melts is of the first material
// afterwards, and as warm as before.
//
// A row of `melting` is {heat of the first material at this one's melting point, heat from which on it is liquid},
// 33 bits.
module melt_lane #(
    parameter MATERIALS = 0
) (
    input  logic               clk,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic               paper,          // under the viscous law nothing has energy
    input  logic [15:0]        freezes_below,  // 0: nothing freezes
    input  logic [(33<<MATERIALS)-1:0] melting,
    input  logic [15:0]        reheat,
    output voxmelt_pkg::cell_t cell_out        // 5 moves later
);
  localparam [15:0] FULL = 16'd4032;  // the least amount that freezes
  wire cold = (cell_in.state == voxmelt_pkg::LIQUID) & (cell_in.heat < freezes_below);
  wire freezes = cold & cell_in.touches & (cell_in.amount >= FULL);
  logic [3:0] material;
  logic [32:0] row;
  if (MATERIALS != 0) begin : many
    material_of number (
        .stored({cell_in.heat, cell_in.energy, cell_in.amount, cell_in.state}), .material(material));
    assign row = melting[33*material[MATERIALS-1:0]+:33];
  end else begin : one
    assign material = 4'd0;
    assign row = melting;
  end
  wire hot = cell_in.heat >= row[15:0];
  wire melts = hot & (cell_in.state == voxmelt_pkg::SOLID);
  wire warms = hot & (cell_in.state == voxmelt_pkg::LIQUID) & ~freezes;

  voxmelt_pkg::cell_t cell1, cell2, cell4;
  logic [15:0] lacks1, after1;
  logic [16:0] as_first1;
  logic warms1, warms2, warms4, melts1, turns1;
  wire [17:0] turned1 = 18'(after1) + 18'(as_first1);
  logic signed [34:0] gain4;
  product times_reheat (
      .clk(clk), .en(move), .a($signed({2'b0, lacks1})), .b({1'b0, reheat}), .p(gain4));
  delay #(.WIDTH(68), .N(2)) waits (.clk(clk), .en(move), .d({warms2, cell2}), .q({warms4, cell4}));
  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      cell1.touches <= 1'b0;
      cell1.is_set <= cold & ~freezes;
      if (freezes) cell1.state <= voxmelt_pkg::SOLID;
      if (freezes) cell1.energy <= 16'd0;
      melts1 <= melts;
      turns1 <= melts & (material != 4'd0);
      after1 <= cell_in.heat - row[15:0];
      as_first1 <= row[32:16];
      lacks1 <= cell_in.amount - cell_in.energy;
      warms1 <= warms;
      cell2 <= cell1;
      if (melts1) cell2.state <= voxmelt_pkg::LIQUID;
      if (melts1) cell2.energy <= paper ? cell1.amount : 16'd0;
      if (turns1) cell2.heat <= turned1 > 18'd65535 ? 16'hFFFF : turned1[15:0];
      warms2 <= warms1;
      cell_out <= cell4;
      cell_out.energy <= cell4.energy + (warms4 ? gain4[31:16] : 16'd0);
    end
endmodule
