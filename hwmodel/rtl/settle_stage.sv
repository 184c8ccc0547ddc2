// The stage settle: the phase `excess` of the viscous law (docs/automaton.md, section 10). Three scans go up,
// down and up each column. Between two of them a memory turns the column round. Heat that moves along a run
// in one lane holds all of them.
//
// A word is in register 24 of the first scan, in register 7 of the second one and in register 39 of the third
// one when it leaves it.
module settle_stage #(
    parameter P = 1,
    parameter HOT = 1,
    parameter MATERIALS = 0,  // bits of their numbers; 0: there is one
    parameter THERMAL = 1,   // mobility depends on heat
    parameter FREEZES = 1,
    parameter SUM = 28,      // bits of the amount of a run
    parameter LAST = 12,     // of its number of cells, less one
    parameter HEIGHT = 4096  // of a column, at most
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    input  logic [P*67-1:0]     in_cells,   // voxmelt_pkg::cell_t, lane 0 lowest
    output logic                out_valid,
    input  logic                out_ready,
    output logic [P*67-1:0]     out_cells,
    output logic [P-1:0]        out_runs,   // which of them are in a run
    output logic [P*92-1:0]     out_shows,  // what these show: {shut, dead, limit, mobility, head} each
    input  logic                follows,
    input  logic [31:0]         step,
    input  logic [15:0]         substep,    // these two are of the pass whose first token comes next
    input  logic [35:0]         pace,       // the mobility of one sub-step
    input  voxmelt_pkg::place_t last,
    input  logic [23:0]         lag,
    input  logic                hot,
    input  logic                thermal,
    input  logic [15:0]         mobility_reference,
    input  logic [15:0]         mobility_rate,
    input  logic [23:0]         yield_stress,
    input  logic [3:0]          stiffness,
    input  logic [(48<<MATERIALS)-1:0] beds,  // of each material, see bed_unit.sv
    output logic                holds       // a serial divider works
);
  logic [P-1:0] rises, sinks;
  assign holds = |rises | |sinks;
  logic move, here, overlaps;
  voxmelt_pkg::place_t came, left;
  logic [31:0] step_came, step_left;
  logic [23:0] fill;
  logic drained;
  stage_control control (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid),
      .out_ready(out_ready), .hold(holds), .follows(follows), .step(step), .last(last), .lag(lag),
      .move(move), .here(here), .overlaps(overlaps), .came(came), .left(left), .step_came(step_came),
      .step_left(step_left), .fill(fill), .drained(drained));

  // Two passes at most are under way. A bit that goes along with the words tells them apart. Passes that overlap
  // have one pace.
  logic odd, odd1, odd4, odd19, odd24, odd_down1, odd_down6, unused_pass;
  logic [15:0] dither, of_substep, even_dither, odd_dither;
  logic [35:0] pace_now;
  dither_unit reverse (.step(step), .dither(dither));
  dither_unit reverse_substep (.step(32'(substep)), .dither(of_substep));
  wire first = here & (came == '0);
  wire odd_now = odd ^ first;
  always_ff @(posedge clk) begin
    if (rst) odd <= 1'b0;
    else if (move) odd <= odd_now;
    if (move & first & odd_now) odd_dither <= dither + of_substep;
    if (move & first & ~odd_now) even_dither <= dither + of_substep;
    if (move & first) pace_now <= pace;
    if (move) odd1 <= odd_now;
  end
  delay #(.WIDTH(1), .N(3)) odds4 (.clk(clk), .en(move), .d(odd1), .q(odd4));
  delay #(.WIDTH(1), .N(15)) odds19 (.clk(clk), .en(move), .d(odd4), .q(odd19));
  delay #(.WIDTH(1), .N(5)) odds24 (.clk(clk), .en(move), .d(odd19), .q(odd24));
  delay #(.WIDTH(1), .N(5)) odds_down (.clk(clk), .en(move), .d(odd_down1), .q(odd_down6));

  // The two memories. Words have what the scene has.
  localparam HEATS = HOT != 0 ? 16 : 0, ORDERS = HOT != 0 ? 17 : 0, MEANS = THERMAL != 0 ? 16 : 0;
  localparam SETS = FREEZES != 0 ? 1 : 0;
  localparam RECORD = 3 + SUM + LAST, AT_HEAT = RECORD, AT_ORDER = RECORD + 16, AT_MEAN = RECORD + 33;
  localparam DOWN = RECORD + HEATS + ORDERS + MEANS + SETS, UP = RECORD + HEATS + MEANS + SETS;
  logic [P*DOWN-1:0] to_down, from_down;
  logic [P*UP-1:0] to_up, from_up;
  logic [11:0] at_down1, y1, y10;
  wire goes_down = move & (fill >= 24'd24), goes_up = move & (fill >= 24'd31);
  column_reverser #(.WIDTH(P * DOWN), .DEPTH(HEIGHT)) downwards (
      .clk(clk), .rst(rst), .restart(move & drained), .en(goes_down), .last_y(last.y), .d(to_down),
      .pass(odd24), .q(from_down), .at_q(at_down1), .pass_q(odd_down1));
  column_reverser #(.WIDTH(P * UP), .DEPTH(HEIGHT)) upwards (
      .clk(clk), .rst(rst), .restart(move & drained), .en(goes_up), .last_y(last.y), .d(to_up),
      .pass(1'b0), .q(from_up), .at_q(y1), .pass_q(unused_pass));
  delay #(.WIDTH(12), .N(9)) heights (.clk(clk), .en(move), .d(y1), .q(y10));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    logic [SUM+LAST+52:0] word24, word1;
    logic [SUM+LAST+35:0] word7, word_up1;
    sum_scan #(.SUM(SUM), .LAST(LAST), .MATERIALS(MATERIALS)) sums (
        .clk(clk), .rst(rst), .move(move), .cell_in(here ? in_cells[lane*67+:67] : {17'd0, voxmelt_pkg::BORDER}),
        .bottom(came.y == 12'd0), .live4(fill >= 24'd4), .hot(hot), .dither4(odd4 ? odd_dither : even_dither),
        .dither19(odd19 ? odd_dither : even_dither), .works(rises[lane]), .word(word24));
    record_scan #(.SUM(SUM), .LAST(LAST)) records (
        .clk(clk), .rst(rst), .move(move), .word1(word1), .highest1(at_down1 == 12'd0),
        .live6(fill >= 24'(last.y) + 24'd31), .dither6(odd_down6 ? odd_dither : even_dither),
        .works(sinks[lane]), .word7(word7));
    show_scan #(.SUM(SUM), .LAST(LAST), .MATERIALS(MATERIALS)) show (
        .clk(clk), .move(move), .word1(word_up1), .y10(y10), .pace10(pace_now), .hot(hot),
        .thermal(thermal), .mobility_reference(mobility_reference), .mobility_rate(mobility_rate),
        .yield_stress(yield_stress), .stiffness(stiffness), .beds(beds), .cell_out(out_cells[lane*67+:67]),
        .in_run(out_runs[lane]), .shows(out_shows[lane*92+:92]));

    wire [DOWN-1:0] stored = from_down[lane*DOWN+:DOWN];
    wire [UP-1:0] stored_up = from_up[lane*UP+:UP];
    assign to_down[lane*DOWN+:RECORD] = word24[RECORD-1:0];
    assign to_up[lane*UP+:RECORD] = word7[RECORD-1:0];
    assign word1[RECORD-1:0] = stored[RECORD-1:0];
    assign word_up1[RECORD-1:0] = stored_up[RECORD-1:0];
    if (HOT != 0) begin : heats
      assign to_down[lane*DOWN+RECORD+:33] = word24[AT_HEAT+:33];
      assign word1[AT_HEAT+:33] = stored[RECORD+:33];
      assign to_up[lane*UP+RECORD+:16] = word7[AT_HEAT+:16];
      assign word_up1[AT_HEAT+:16] = stored_up[RECORD+:16];
    end else begin : no_heats
      assign word1[AT_HEAT+:33] = 33'd0;
      assign word_up1[AT_HEAT+:16] = 16'd0;
    end
    if (THERMAL != 0) begin : means
      assign to_down[lane*DOWN+RECORD+HEATS+ORDERS+:16] = word24[AT_MEAN+:16];
      assign word1[AT_MEAN+:16] = stored[RECORD+HEATS+ORDERS+:16];
      assign to_up[lane*UP+RECORD+HEATS+:16] = word7[AT_ORDER+:16];
      assign word_up1[AT_ORDER+:16] = stored_up[RECORD+HEATS+:16];
    end else begin : no_means
      assign word1[AT_MEAN+:16] = 16'd0;
      assign word_up1[AT_ORDER+:16] = 16'd0;
    end
    if (FREEZES != 0) begin : sets
      assign to_down[lane*DOWN+DOWN-1] = word24[AT_MEAN+16];
      assign word1[AT_MEAN+16] = stored[DOWN-1];
      assign to_up[lane*UP+UP-1] = word7[AT_ORDER+16];
      assign word_up1[AT_ORDER+16] = stored_up[UP-1];
    end else begin : no_sets
      assign word1[AT_MEAN+16] = 1'b0;
      assign word_up1[AT_ORDER+16] = 1'b0;
    end
  end
endmodule
