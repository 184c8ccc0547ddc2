// Reads what the cells of one lane show, upwards, at one place of the stage spread (docs/automaton.md, section
// 10). A run's head lies in the words of all its cells, and its pace in the word of the blocked cell below it.
//
// A word is {shown, heat, amount, beside a wall, set, ground}. What is shown is {rise, pace} of a blocked cell
// and {.., head} of another one. A pace is {shut, dead, limit, mobility}.
module run_reader #(
    parameter BRINGS = 0  // the pace comes with the run's first cell
) (
    input  logic         clk,
    input  logic         move,
    input  logic [107:0] word0,
    input  logic [11:0]  y0,
    input  logic [61:0]  pace0,    // of a run on the floor, or with BRINGS of the run that begins
    output logic [19:0]  bed1,     // {blocked, has a bed, its height in 1/16 cell}
    output logic [167:0] seen2     // what a pair looks at, see below
);
  localparam [1:0] RUN = 2'd1;
  wire blocked0 = word0[1], runs0 = word0[1:0] == RUN, floor0 = y0 == 12'd0;
  logic below_blocked, below_run;
  logic [13:0] rise;
  logic [61:0] next, pace;
  logic [29:0] head;
  logic [17:0] run_bed;
  wire on_blocked = floor0 | below_blocked, on_run = ~floor0 & below_run;
  wire [13:0] rise_now = floor0 ? 14'd512 : rise;
  wire [29:0] bed_head = {9'd0, y0, 9'd0} + {16'd0, rise_now} - 30'd512;
  wire first = runs0 & on_blocked;
  wire [61:0] next_now = BRINGS != 0 | floor0 ? pace0 : next;
  wire [61:0] pace_now = first ? next_now : pace;
  wire [29:0] head0 = word0[65:36];
  wire [17:0] bed_now = first ? bed_head[22:5] : run_bed;
  wire [16:0] inert = {1'b0, word0[19:4]} + 17'd2048;

  logic blocked1, runs1, set1, has_bed1;
  logic [15:0] amount1, heat1;
  logic [29:0] head1;
  logic [17:0] height1;
  logic [61:0] pace1;
  assign bed1 = {blocked1, has_bed1, height1};
  wire [21:0] mobility1 = pace1[21:0], limit1 = {pace1[35:22], 8'd0};

  always_ff @(posedge clk)
    if (move) begin
      below_blocked <= blocked0;
      below_run <= runs0;
      if (blocked0) begin
        rise <= word0[0] ? inert[16:3] : {4'd0, word0[107:98]};
        next <= word0[97:36];
      end
      if (runs0) begin
        head <= head0;
        run_bed <= bed_now;
        pace <= pace_now;
      end

      blocked1 <= blocked0;
      runs1 <= runs0;
      set1 <= word0[2];
      amount1 <= word0[19:4];
      heat1 <= word0[35:20];
      has_bed1 <= ~blocked0 & (runs0 | on_blocked | on_run);
      head1 <= runs0 ? head0 : on_blocked ? bed_head : on_run ? head : {9'd0, y0, 9'd0} - 30'd1024;
      height1 <= runs0 ? bed_now : on_blocked ? bed_head[22:5] : run_bed;
      pace1 <= runs0 ? pace_now : on_run & ~on_blocked ? {26'd0, pace[35:0]} : 62'd0;

      // {blocked, in a run, set, has a bed, shut, dead, limit, mobility towards a bare flank and towards a
      // run, bed, head, heat, amount}
      seen2 <= {blocked1, runs1, set1, has_bed1, pace1[61:36], pace1[35:22],
                mobility1 < 22'd2097152 ? mobility1 : 22'd2097152, mobility1 < limit1 ? mobility1 : limit1,
                height1, head1, heat1, amount1};
    end
endmodule
