// The word of a cell that comes to the stage spread: register 9 is position 0. Until then a solid's bed is
// computed. run_reader.sv has the parts of a word.
module spread_taker #(
    parameter MATERIALS = 0
) (
    input  logic               clk,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic               in_run,
    input  logic [91:0]        shows,       // {shut, dead, limit, mobility, head}
    input  logic               hot,
    input  logic [(48<<MATERIALS)-1:0] beds,
    output logic [107:0]       word0,
    output logic [61:0]        pace0,       // of a cell in a run
    output logic [3:0]         material0    // of a solid
);
  localparam [1:0] OUTSIDE = 2'd0, RUN = 2'd1;
  wire [1:0] ground = cell_in.state[1] ? cell_in.state : in_run ? RUN : OUTSIDE;
  logic [35:0] done0;
  logic [91:0] shows0;
  logic [13:0] rise0;
  logic [3:0] material;
  if (MATERIALS != 0) begin : many
    assign material = cell_in.state == voxmelt_pkg::SOLID ? cell_in.energy[3:0] : 4'd0;
    delay #(.WIDTH(4), .N(9)) numbers (.clk(clk), .en(move), .d(material), .q(material0));
  end else begin : one
    assign {material, material0} = 8'd0;
  end
  bed_unit #(.MATERIALS(MATERIALS)) bed (
      .clk(clk), .en(move), .solid(cell_in.state == voxmelt_pkg::SOLID), .amount(cell_in.amount),
      .heat(cell_in.heat), .material(material), .hot(hot), .beds(beds), .rise(rise0));
  delay #(.WIDTH(128), .N(9)) waits (
      .clk(clk), .en(move), .d({shows, cell_in.heat, cell_in.amount, 1'b0, cell_in.is_set, ground}),
      .q({shows0, done0}));
  assign pace0 = shows0[91:30];
  assign word0 = {done0[1] ? {rise0[9:0], 62'd0} : {42'd0, shows0[29:0]}, done0};
endmodule
