// Melting, freezing and reheating of one lane (docs/automaton.md, section 7).
module melt_lane (
    input  logic               clk,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic               paper,          // under the viscous law nothing has energy
    input  logic [15:0]        freezes_below,  // 0: nothing freezes
    input  logic [15:0]        liquid_from,
    input  logic [15:0]        reheat,
    output voxmelt_pkg::cell_t cell_out        // 5 moves later
);
  localparam [15:0] FULL = 16'd4032;  // the least amount that freezes
  wire cold = (cell_in.state == voxmelt_pkg::LIQUID) & (cell_in.heat < freezes_below);
  wire freezes = cold & cell_in.touches & (cell_in.amount >= FULL);
  wire hot = cell_in.heat >= liquid_from;
  wire melts = hot & (cell_in.state == voxmelt_pkg::SOLID);
  wire warms = hot & (cell_in.state == voxmelt_pkg::LIQUID) & ~freezes;

  voxmelt_pkg::cell_t cell1, cell4;
  logic [15:0] lacks1;
  logic warms1, warms4;
  logic signed [34:0] gain4;
  product times_reheat (
      .clk(clk), .en(move), .a($signed({2'b0, lacks1})), .b({1'b0, reheat}), .p(gain4));
  delay #(.WIDTH(68), .N(3)) waits (.clk(clk), .en(move), .d({warms1, cell1}), .q({warms4, cell4}));
  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      cell1.touches <= 1'b0;
      cell1.is_set <= cold & ~freezes;
      cell1.state <= freezes ? voxmelt_pkg::SOLID : melts ? voxmelt_pkg::LIQUID : cell_in.state;
      cell1.energy <= freezes ? 16'd0 : melts & paper ? cell_in.amount : cell_in.energy;
      lacks1 <= cell_in.amount - cell_in.energy;
      warms1 <= warms;
      cell_out <= cell4;
      cell_out.energy <= cell4.energy + (warms4 ? gain4[31:16] : 16'd0);
    end
endmodule
