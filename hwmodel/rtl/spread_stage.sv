// The stage spread of the viscous law (docs/automaton.md, section 11, one stage). A cell q that comes completes
// four pairs, with its south s and the cells w and sw west of both: q with sw, w with s, w with sw, s with sw.
// In lane 0, w and sw are the last lane's cells of a column before. Behind the last block of a row these are
// the ends of that row. So each pair is computed once.
//
// A word has a memory for what pairs look at, and one for what it got, which follows 25 positions later.
// Position 0 is register 9.
module spread_stage #(
    parameter P = 1,
    parameter HOT = 1,
    parameter MATERIALS = 0,  // bits of their numbers; 0: there is one
    parameter DEPTH_SOUTH_EAST = 4096,  // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768,
    parameter DEPTH_FINISHED = 4120,
    parameter BLOCKS = 4096             // of a plane, at most
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    input  logic [P*67-1:0]     in_cells,    // voxmelt_pkg::cell_t, lane 0 lowest
    input  logic [P-1:0]        in_runs,     // which of them are in a run
    input  logic [P*92-1:0]     in_shows,    // what these show
    output logic                out_valid,
    input  logic                out_ready,
    output logic [P*67-1:0]     out_cells,
    output logic [P-1:0]        out_runs,
    input  logic                follows,
    input  logic [31:0]         step,
    input  logic [15:0]         substep,     // these three are of the pass whose first token comes next
    input  logic [36:0]         reciprocal,  // of the number of sub-steps, in 1/2^36
    input  logic [39:0]         turns,       // which sub-step this one is for each axis
    input  voxmelt_pkg::place_t last,
    input  logic [23:0]         lag,
    input  logic [23:0]         south_east,  // lengths of the memories
    input  logic [23:0]         north,
    input  logic [23:0]         finished,
    input  logic                finds_walls,
    input  logic                hot,
    input  logic [(48<<MATERIALS)-1:0] beds  // of each material, see bed_unit.sv
);
  localparam HEATS = HOT != 0 ? 16 + MATERIALS : 0;  // heat, and the material above it
  localparam WORD = 92 + HEATS, DONE = 20 + HEATS, SUM = HOT != 0 ? 48 : 16;
  logic move, here, overlaps;
  voxmelt_pkg::place_t came, left;
  logic [31:0] step_came, step_left;
  logic [23:0] fill;
  logic drained;
  stage_control control (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .out_valid(out_valid),
      .out_ready(out_ready), .hold(1'b0), .follows(follows), .step(step), .last(last), .lag(lag),
      .move(move), .here(here), .overlaps(overlaps), .came(came), .left(left), .step_came(step_came),
      .step_left(step_left), .fill(fill), .drained(drained));

  // What is known of a token at positions 0, 1 and 11. Pairs of s and sw, and those at the end of a row, may
  // be of the last pass.
  logic odd_now, odd_finished;
  logic [11:0] y0, y11;
  logic west0, south0, ends_row0, ends_pass0, at_end0, old_row0, old_plane0, row0, odd0;
  logic west1, south1, ends_row1, ends_pass1, at_end1, row1, odd11, old_row11, old_plane11;
  wire plane0 = came.plane == 12'd0;
  wire begins_row = came.block == 12'd0;
  delay #(.WIDTH(21), .N(9)) places (
      .clk(clk), .en(move),
      .d({odd_now, begins_row & (plane0 ? overlaps & (last.plane != 12'd0) : came.plane != 12'd1),
          plane0 & begins_row, plane0, came.plane == last.plane, overlaps | ~plane0, came.block == last.block,
          ~plane0, ~begins_row, came.y}),
      .q({odd0, row0, old_row0, old_plane0, at_end0, ends_pass0, ends_row0, south0, west0, y0}));
  delay #(.WIDTH(6), .N(1)) places1 (
      .clk(clk), .en(move), .d({row0, at_end0, ends_pass0, ends_row0, south0, west0}),
      .q({row1, at_end1, ends_pass1, ends_row1, south1, west1}));
  delay #(.WIDTH(15), .N(11)) heights (
      .clk(clk), .en(move), .d({odd0, old_row0, old_plane0, y0}), .q({odd11, old_row11, old_plane11, y11}));

  logic [15:0] rounding_x, rounding_z, rounding_up, rounding_down, finish_dither;
  spread_passes passes (
      .clk(clk), .rst(rst), .move(move), .first(here & (came == '0)), .step(step), .substep(substep),
      .reciprocal(reciprocal), .turns(turns), .y11(y11), .odd11(odd11), .old_row11(old_row11),
      .old_plane11(old_plane11), .odd_finished(odd_finished), .odd_now(odd_now), .rounding_x(rounding_x),
      .rounding_z(rounding_z), .rounding_up(rounding_up), .rounding_down(rounding_down),
      .finish_dither(finish_dither));
  voxmelt_pkg::place_t unused_place;
  logic [31:0] finishes;
  place_behind finish_place (
      .clk(clk), .rst(rst), .move(move), .behind(lag - 24'd21), .fill(fill), .drained(drained), .last(last),
      .step_came({31'd0, odd_now}), .place(unused_place), .step(finishes));
  assign odd_finished = finishes[0];

  // The paces of runs on the floor. One memory has those of the plane before.
  logic [P*62-1:0] paces0, floors[0:BLOCKS-1], floor_south;
  logic [61:0] floor_now, floor_west, floor_south_west;
  localparam BLOCK = BLOCKS > 1 ? $clog2(BLOCKS) : 1;
  logic [11:0] block8;
  logic begins8;
  delay #(.WIDTH(13), .N(8)) blocks8 (
      .clk(clk), .en(move), .d({came.y == 12'd0, came.block}), .q({begins8, block8}));
  always_ff @(posedge clk)
    if (move) begin
      if (begins8) begin
        floor_south_west <= floor_south[(P-1)*62+:62];
        floor_west <= floor_now;
        floor_south <= floors[block8[BLOCK-1:0]];
      end
      if (y0 == 12'd0) begin
        floor_now <= paces0[(P-1)*62+:62];
        floors[block8[BLOCK-1:0]] <= paces0;  // the next token is of the same column
      end
    end

  // The memories of words, and of what they got.
  logic [P*WORD-1:0] to_west, from_west, to_south, from_south;
  logic [WORD-1:0] to_south_west, from_south_west;
  logic [P*DONE-1:0] to_done, from_done;
  logic [P*SUM-1:0] here25, west_held25, west26, south_held25, south26, last_held25;
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_SOUTH_EAST)) columns (
      .clk(clk), .rst(rst), .en(move), .delay(south_east), .d(to_west), .q(from_west));
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(to_south), .q(from_south));
  line_memory #(.WIDTH(WORD), .DEPTH(DEPTH_SOUTH_EAST + 2)) last_lane (
      .clk(clk), .rst(rst), .en(move), .delay(south_east + 24'd2), .d(to_south_west), .q(from_south_west));
  line_memory #(.WIDTH(P * DONE), .DEPTH(DEPTH_FINISHED)) done (
      .clk(clk), .rst(rst), .en(move), .delay(finished), .d(to_done), .q(from_done));
  line_memory #(.WIDTH(P * SUM), .DEPTH(DEPTH_SOUTH_EAST + 2)) column_sums (
      .clk(clk), .rst(rst), .en(move), .delay(south_east + 24'd2), .d(here25), .q(west_held25));
  line_memory #(.WIDTH(P * SUM), .DEPTH(DEPTH_NORTH)) plane_sums (
      .clk(clk), .rst(rst), .en(move), .delay(north - 24'd1), .d(west26), .q(south_held25));
  line_memory #(.WIDTH(P * SUM), .DEPTH(DEPTH_SOUTH_EAST + 1)) last_sums (
      .clk(clk), .rst(rst), .en(move), .delay(south_east + 24'd1), .d(south26), .q(last_held25));

  // What pairs look at: q and s of each lane, and of the last lane w and sw, a column later.
  logic [P*108-1:0] words0, souths0;
  logic [P-1:0] words1;  // is it blocked?
  logic [P*20-1:0] beds1, south_beds1;
  logic [P*168-1:0] seen2, south_seen2;
  logic [P*14-1:0] edges2, south_edges2;
  logic [P*192-1:0] gifts22;  // {s with sw, w with sw, w with s, q with sw}, a sum of 48 bits each
  logic [107:0] west_word0, south_west_word0;
  logic [19:0] west_bed1, south_west_bed1;
  logic [167:0] west_seen2, south_west_seen2;
  logic [13:0] west_edges2, south_west_edges2;
  unpack_spread #(.HOT(HOT), .MATERIALS(MATERIALS)) unpack_west (.stored(from_west[(P-1)*WORD+:WORD]), .word(west_word0));
  unpack_spread #(.HOT(HOT), .MATERIALS(MATERIALS)) unpack_south_west (.stored(from_south_west), .word(south_west_word0));
  run_reader west_reader (
      .clk(clk), .move(move), .word0(west_word0), .y0(y0), .pace0(floor_west), .bed1(west_bed1), .seen2(west_seen2));
  run_reader south_west_reader (
      .clk(clk), .move(move), .word0(south_west_word0), .y0(y0), .pace0(floor_south_west), .bed1(south_west_bed1),
      .seen2(south_west_seen2));
  delay #(.WIDTH(28), .N(2)) edges_of_last (
      .clk(clk), .en(move), .d({edges_of(west_word0), edges_of(south_west_word0)}),
      .q({west_edges2, south_west_edges2}));
  assign to_south_west = from_south[(P-1)*WORD+:WORD];

  // What the last lane's cells get from lane 0.
  logic [47:0] to_last23, to_last24, to_last25, from_last23, from_last24, from_last25, x23;
  always_ff @(posedge clk)
    if (move) begin
      to_last23 <= sum(gifts22[48+:48], gifts22[96+:48]);
      to_last24 <= to_last23;
      to_last25 <= to_last24;
      from_last23 <= sum(gifts22[0+:48], gifts22[96+:48]);
      x23 <= gifts22[144+:48];
      from_last24 <= sum(from_last23, x23);
      from_last25 <= from_last24;
    end

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    localparam NEXT = (lane + 1) % P, LAST = (lane + P - 1) % P;
    localparam [0:0] ENDS = lane == P - 1;  // its eastern cells are in another token
    wire [107:0] word0 = words0[lane*108+:108];
    wire [107:0] south0_word = souths0[lane*108+:108];
    logic [107:0] word1, word2;
    logic [61:0] above2;
    logic wall2;
    logic [3:0] material0, material2, material23;
    spread_taker #(.MATERIALS(MATERIALS)) taker (
        .clk(clk), .move(move), .cell_in(here ? in_cells[lane*67+:67] : {17'd0, voxmelt_pkg::BORDER}),
        .in_run(here & in_runs[lane]), .shows(in_shows[lane*92+:92]), .hot(hot), .beds(beds),
        .word0(words0[lane*108+:108]), .pace0(paces0[lane*62+:62]), .material0(material0));
    unpack_spread #(.HOT(HOT), .MATERIALS(MATERIALS)) unpack_south (
        .stored(from_south[lane*WORD+:WORD]), .word(souths0[lane*108+:108]));
    run_reader #(.BRINGS(1)) reader (
        .clk(clk), .move(move), .word0(word0), .y0(y0), .pace0(paces0[lane*62+:62]), .bed1(beds1[lane*20+:20]),
        .seen2(seen2[lane*168+:168]));
    run_reader south_reader (
        .clk(clk), .move(move), .word0(south0_word), .y0(y0), .pace0(floor_south[lane*62+:62]),
        .bed1(south_beds1[lane*20+:20]), .seen2(south_seen2[lane*168+:168]));
    delay #(.WIDTH(14), .N(2)) edges_of_south (
        .clk(clk), .en(move), .d(edges_of(south0_word)), .q(south_edges2[lane*14+:14]));

    // The window.
    wire [19:0] w1 = lane == 0 ? west_bed1 : beds1[LAST*20+:20];
    wire [19:0] sw1 = lane == 0 ? south_west_bed1 : south_beds1[LAST*20+:20];
    wire [19:0] s1 = south_beds1[lane*20+:20];
    wire [167:0] w2 = lane == 0 ? west_seen2 : seen2[LAST*168+:168];
    wire [167:0] sw2 = lane == 0 ? south_west_seen2 : south_seen2[LAST*168+:168];
    wire has_west1 = lane == 0 ? west1 : 1'b1;
    logic [3:0] valid2;
    logic [2:0] beside_x3, beside_z3;
    logic [19:0] across5;
    spread_window window (
        .clk(clk), .move(move), .q1(beds1[lane*20+:20]), .w1(w1), .s1(s1), .sw1(sw1), .has_west1(has_west1),
        .has_south1(south1), .ends_row1(row1), .ends_pass1(ends_pass1),
        .w_edges2(lane == 0 ? west_edges2 : edges2[LAST*14+:14]), .s_edges2(south_edges2[lane*14+:14]),
        .sw_edges2(lane == 0 ? south_west_edges2 : south_edges2[LAST*14+:14]), .q_edges2(edges2[lane*14+:14]),
        .valid2(valid2), .beside_x3(beside_x3), .beside_z3(beside_z3), .across5(across5));
    pair_unit #(.DIAGONAL(1)) up (
        .clk(clk), .move(move), .valid2(valid2[0]), .a2(seen2[lane*168+:168]), .b2(sw2), .beside3(3'd0),
        .across5(across5[4:0]), .rounding16(rounding_up), .amount22(gifts22[lane*192+:16]),
        .content22(gifts22[lane*192+16+:32]));
    pair_unit #(.DIAGONAL(1)) down (
        .clk(clk), .move(move), .valid2(valid2[1]), .a2(w2), .b2(south_seen2[lane*168+:168]), .beside3(3'd0),
        .across5(across5[9:5]), .rounding16(rounding_down), .amount22(gifts22[lane*192+48+:16]),
        .content22(gifts22[lane*192+64+:32]));
    pair_unit along_z (
        .clk(clk), .move(move), .valid2(valid2[2]), .a2(w2), .b2(sw2), .beside3(beside_z3),
        .across5(across5[14:10]), .rounding16(rounding_z), .amount22(gifts22[lane*192+96+:16]),
        .content22(gifts22[lane*192+112+:32]));
    pair_unit along_x (
        .clk(clk), .move(move), .valid2(valid2[3]), .a2(south_seen2[lane*168+:168]), .b2(sw2),
        .beside3(beside_x3), .across5(across5[19:15]), .rounding16(rounding_x),
        .amount22(gifts22[lane*192+144+:16]), .content22(gifts22[lane*192+160+:32]));

    // The word goes on, with what lies beside it. A run's pace goes to the blocked cell below it.
    wire east_blocked = ENDS ? ends_row1 : words1[NEXT];
    always_ff @(posedge clk)
      if (move) begin
        word1 <= word0;
        word2 <= word1;
        above2 <= paces0[lane*62+:62];
        wall2 <= ~has_west1 | w1[19] | ~south1 | s1[19] | at_end1 | east_blocked;
      end
    assign words1[lane] = word1[1];
    wire [71:0] shown2 = word2[1] ? {word2[107:98], above2} : {28'd0, edges2[lane*14+:14], word2[65:36]};
    assign to_west[lane*WORD+:20] = {word2[19:4], wall2, word2[2:0]};
    assign to_west[lane*WORD+20+HEATS+:72] = shown2;
    wire [WORD-1:0] west0_word = from_west[lane*WORD+:WORD], south0_stored = from_south[lane*WORD+:WORD];
    assign to_south[lane*WORD+:WORD] = {west0_word[WORD-1:4], west0_word[3] | (ENDS & west0 & words0[1]), west0_word[2:0]};
    assign to_done[lane*DONE+:DONE] = {south0_stored[DONE-1:4], south0_stored[3] | (south0 & word0[1]), south0_stored[2:0]};

    // What the pairs give, and what comes of it.
    logic [47:0] here_sum, south_gain25;
    spread_sums sums (
        .clk(clk), .move(move), .up22(gifts22[lane*192+:48]), .down22(gifts22[lane*192+48+:48]),
        .along_x22(gifts22[lane*192+144+:48]), .next_up22(ENDS ? 48'd0 : gifts22[NEXT*192+:48]),
        .next_down22(ENDS ? 48'd0 : gifts22[NEXT*192+48+:48]),
        .next_x22(ENDS ? 48'd0 : gifts22[NEXT*192+144+:48]), .next_z22(ENDS ? 48'd0 : gifts22[NEXT*192+96+:48]),
        .here25(here_sum), .south25(south_gain25));
    logic [47:0] west_sum, south_sum, finished_sum;
    always_ff @(posedge clk)
      if (move) begin
        west_sum <= sum(48'(west_held25[lane*SUM+:SUM]), ENDS ? to_last25 : 48'd0);
        south_sum <= sum(48'(south_held25[lane*SUM+:SUM]), south_gain25);
        finished_sum <= difference(48'(last_held25[lane*SUM+:SUM]), ENDS ? from_last25 : 48'd0);
      end
    assign here25[lane*SUM+:SUM] = here_sum[SUM-1:0];
    assign west26[lane*SUM+:SUM] = west_sum[SUM-1:0];
    assign south26[lane*SUM+:SUM] = south_sum[SUM-1:0];
    logic [35:0] done23;
    if (HOT != 0) begin : heats
      assign to_west[lane*WORD+20+:16] = word2[35:20];
      assign done23 = from_done[lane*DONE+:36];
    end else begin : no_heats
      assign done23 = {16'd0, from_done[lane*DONE+:DONE]};
    end
    if (MATERIALS != 0) begin : many
      delay #(.WIDTH(4), .N(2)) numbers (.clk(clk), .en(move), .d(material0), .q(material2));
      assign to_west[lane*WORD+36+:MATERIALS] = material2[MATERIALS-1:0];
      assign material23 = 4'(from_done[lane*DONE+36+:MATERIALS]);
    end else begin : one
      assign material23 = 4'd0;
    end
    spread_finish #(.MATERIALS(MATERIALS)) finish (
        .clk(clk), .move(move), .word23(done23), .material23(material23), .amount26(finished_sum[15:0]), .content26(finished_sum[47:16]),
        .dither27(finish_dither), .hot(hot), .finds_walls(finds_walls), .cell_out(out_cells[lane*67+:67]),
        .in_run(out_runs[lane]));
  end

  // What a word keeps of the cells beside it. The bed beside a blocked cell does not rise.
  function automatic [13:0] edges_of(input [107:0] word);
    edges_of = word[1] ? 14'd0 : word[79:66];
  endfunction
  function automatic [47:0] sum(input [47:0] a, input [47:0] b);
    sum = {a[47:16] + b[47:16], a[15:0] + b[15:0]};
  endfunction
  function automatic [47:0] difference(input [47:0] a, input [47:0] b);
    difference = {a[47:16] - b[47:16], a[15:0] - b[15:0]};
  endfunction
endmodule

// The word of a memory, with heat or without it.
module unpack_spread #(
    parameter HOT = 1,
    parameter MATERIALS = 0
) (
    input  logic [92+(HOT!=0?16+MATERIALS:0)-1:0] stored,
    output logic [107:0]                word
);
  if (HOT != 0) begin : heats
    assign word = {stored[36+MATERIALS+:72], stored[35:0]};
  end else begin : no_heats
    assign word = {stored[91:20], 16'd0, stored[19:0]};
  end
endmodule
