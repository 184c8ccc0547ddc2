// The stage apply: what the patterns say flows (paper law). What a cell gives depends on itself alone. It is computed when the cell comes, for its southern neighbours, and once more
// behind the plane memory, for all others.
//
// A word in register 1 is at position 0, and its gifts are known at position 9. Sums are {content, energy,
// amount}.
module apply_stage #(
    parameter P = 1,
    parameter HOT = 1,
    parameter TABLE = 1,                // shares may follow from the pattern
    parameter PRINTED = 1,              // the energy may be read as printed
    parameter FOUR = 1,                 // neighbours may be four; eight give less each
    parameter DEPTH_SOUTH_EAST = 4096,  // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768,
    parameter DEPTH_EAST = 4096,
    parameter DEPTH_FINISHED = 4096
) (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    input  logic [P*67-1:0]     in_cells,   // voxmelt_pkg::cell_t, lane 0 lowest
    output logic                out_valid,
    input  logic                out_ready,
    output logic [P*67-1:0]     out_cells,
    input  logic                follows,
    input  logic [31:0]         step,
    input  voxmelt_pkg::place_t last,
    input  logic [23:0]         lag,
    input  logic [23:0]         south_east,   // lengths of the memories
    input  logic [23:0]         north,
    input  logic [23:0]         east,
    input  logic [23:0]         finished,     // of lanes that wait for lane P - 1
    input  logic [511:0]        shares,
    input  logic [1023:0]       table_shares,
    input  logic                by_table,
    input  logic                printed,
    input  logic                eight,
    input  logic                hot,
    input  logic [47:0]         alpha
);
  localparam CELL = HOT != 0 ? 50 : 34;
  localparam SUM = HOT != 0 ? 64 : 32;
  localparam PART = FOUR != 0 ? 14 : 13;      // of what comes from the south
  localparam SOUTH = HOT != 0 ? 3 * PART + 16 : 2 * PART;
  localparam WORD = SOUTH + 8 + CELL;         // {sum, pattern, cell}
  localparam LATE = SUM + 34 + CELL;          // {sum, left energy, left amount, footing, cell}
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

  logic west0, south0, floor0, west9, south9;
  always_ff @(posedge clk)
    if (move) begin
      west0 <= came.block != 12'd0;
      south0 <= here & (came.plane != 12'd0);
      floor0 <= came.y == 12'd0;
    end
  delay #(.WIDTH(2), .N(9)) flags (.clk(clk), .en(move), .d({west0, south0}), .q({west9, south9}));

  // The dithers of what is finished: early in all lanes but the last, and late in that.
  logic [31:0] early_step, late_step;
  logic [15:0] early3, early4, late3, late4;
  voxmelt_pkg::place_t early_place, late_place;
  place_behind of_early (
      .clk(clk), .rst(rst), .move(move), .behind(lag - east - 24'd24), .fill(fill), .drained(drained),
      .last(last), .step_came(step_came), .place(early_place), .step(early_step));
  place_behind of_late (
      .clk(clk), .rst(rst), .move(move), .behind(lag - 24'd22), .fill(fill), .drained(drained),
      .last(last), .step_came(step_came), .place(late_place), .step(late_step));
  dither_unit early_dither (.step(early_step), .dither(early3));
  dither_unit late_dither (.step(late_step), .dither(late3));
  delay #(.WIDTH(32), .N(1)) dithers (.clk(clk), .en(move), .d({early3, late3}), .q({early4, late4}));

  // The memories. What lane P - 1 gives to the east of itself waits for its receiver beside them.
  logic [P*WORD-1:0] to_south_east, from_south_east, to_north, from_north;
  logic [LATE-1:0] to_east, from_east;
  logic [63:0] corner12, corner_gift, axis12, axis_gift, north_corner12, north_corner_gift;
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_SOUTH_EAST)) early (
      .clk(clk), .rst(rst), .en(move), .delay(south_east), .d(to_south_east), .q(from_south_east));
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(to_north), .q(from_north));
  line_memory #(.WIDTH(LATE), .DEPTH(DEPTH_EAST)) late (
      .clk(clk), .rst(rst), .en(move), .delay(east), .d(to_east), .q(from_east));
  gift_memory #(.HOT(HOT), .DEPTH(DEPTH_SOUTH_EAST)) south_eastern (
      .clk(clk), .rst(rst), .move(move), .delay(south_east), .gift(corner12), .later(corner_gift));
  gift_memory #(.HOT(HOT), .DEPTH(DEPTH_EAST)) eastern (
      .clk(clk), .rst(rst), .move(move), .delay(east), .gift(axis12), .later(axis_gift));
  gift_memory #(.HOT(HOT), .DEPTH(DEPTH_EAST)) north_eastern (
      .clk(clk), .rst(rst), .move(move), .delay(east), .gift(north_corner12), .later(north_corner_gift));

  // What each lane's window moves: from a cell, its south, its west and its south-west.
  logic [P*64-1:0] here_south, here_corner, south_north, south_goes_west, south_corner;
  logic [P*64-1:0] here_east, south_east_axis, south_east_corner;  // to the window of the next lane

  // Cells of all lanes but the last one are finished early, and wait for it.
  localparam WAIT = P > 1 ? (P - 1) * CELL : 1;
  logic [WAIT-1:0] ready_cells, waited_cells;
  if (P > 1) begin : waiting
    line_memory #(.WIDTH(WAIT), .DEPTH(DEPTH_FINISHED)) cells (
        .clk(clk), .rst(rst), .en(move), .delay(finished), .d(ready_cells), .q(waited_cells));
  end else begin : not_waiting
    assign ready_cells = '0;
    assign waited_cells = ready_cells;
  end

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    localparam NEXT = (lane + 1) % P, LAST = (lane + P - 1) % P;
    localparam [0:0] ENDS = lane == P - 1;  // its eastern cells are in another token
    wire [49:0] south0_word = 50'(from_north[lane*WORD+:CELL]);
    wire [7:0] south0_pattern = from_north[lane*WORD+CELL+:8];
    wire [63:0] south0_sum = unpacked(from_north[lane*WORD+CELL+8+:SOUTH]);
    logic [49:0] stored, word0, south1;
    logic [7:0] pattern0;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    always_ff @(posedge clk)
      if (move) begin
        word0 <= here ? stored : voxmelt_pkg::BORDER;
        pattern0 <= here ? in_cells[lane*67+56+:8] : 8'd0;
        south1 <= south0_word;
      end

    logic [15:0] left_amount11, left_energy11, unused_amount, unused_energy;
    wire [31:0] left11 = {left_energy11, left_amount11};
    logic [49:0] word9, south9_word, word12, south12;
    logic [1:0] state1, footing9;
    logic [7:0] pattern9, pattern12, south9_pattern;
    logic [1:0] footing12;
    logic [31:0] left12;
    logic [63:0] south9_sum;
    always_ff @(posedge clk) if (move) state1 <= word0[1:0];
    delay #(.WIDTH(8), .N(9)) patterns (.clk(clk), .en(move), .d(pattern0), .q(pattern9));
    delay #(.WIDTH(58), .N(3)) with_sums (
        .clk(clk), .en(move), .d({pattern9, word9}), .q({pattern12, word12}));
    delay #(.WIDTH(50), .N(9)) early_words (.clk(clk), .en(move), .d(word0), .q(word9));
    wire [1:0] footing0 = floor0 ? 2'd2 : footing_on(state1), south_footing0 = floor0 ? 2'd2 : footing_on(south1[1:0]);
    delay #(.WIDTH(124), .N(9)) south_words (
        .clk(clk), .en(move), .d({south0_sum, south_footing0, south0_pattern, south0_word}),
        .q({south9_sum, footing9, south9_pattern, south9_word}));
    delay #(.WIDTH(52), .N(3)) late_words (
        .clk(clk), .en(move), .d({footing9, south9_word}), .q({footing12, south12}));
    always_ff @(posedge clk) if (move) left12 <= left11;

    logic [255:0] gifts, south_gifts;
    logic [63:0] corner, south_corner_gift;
    gift_unit #(.TABLE(TABLE), .PRINTED(PRINTED)) gift (
        .clk(clk), .move(move), .stored(word0), .pattern(pattern0), .footing(footing0), .shares(shares),
        .by_table(by_table), .table_shares(table_shares), .printed(printed), .alpha(alpha), .eight(eight),
        .axes(gifts), .corner(corner), .left_amount(unused_amount), .left_energy(unused_energy));
    gift_unit #(.TABLE(TABLE), .PRINTED(PRINTED)) south_gift (
        .clk(clk), .move(move), .stored(south0_word), .pattern(south0_pattern), .footing(south_footing0),
        .shares(shares), .by_table(by_table), .table_shares(table_shares), .printed(printed), .alpha(alpha),
        .eight(eight), .axes(south_gifts), .corner(south_corner_gift), .left_amount(left_amount11),
        .left_energy(left_energy11));

    wire has_west = lane == 0 ? west9 : 1'b1;
    assign here_south[lane*64+:64] = south9 & pattern9[3] ? gifts[192+:64] : 64'd0;
    assign here_corner[lane*64+:64] = has_west & south9 & pattern9[7] ? corner : 64'd0;
    assign south_north[lane*64+:64] = south9 & south9_pattern[2] ? south_gifts[128+:64] : 64'd0;
    assign south_goes_west[lane*64+:64] = has_west & south9_pattern[1] ? south_gifts[64+:64] : 64'd0;
    assign south_corner[lane*64+:64] = has_west & south9 & south9_pattern[6] ? south_corner_gift : 64'd0;
    assign here_east[lane*64+:64] = pattern9[5] ? corner : 64'd0;
    assign south_east_axis[lane*64+:64] = south9_pattern[0] ? south_gifts[0+:64] : 64'd0;
    assign south_east_corner[lane*64+:64] = south9_pattern[4] ? south_corner_gift : 64'd0;

    wire [63:0] from_west_corner = ~(has_west & south9) ? 64'd0 : lane == 0 ? corner_gift : here_east[LAST*64+:64];
    wire [63:0] from_west_axis = ~has_west ? 64'd0 : lane == 0 ? axis_gift : south_east_axis[LAST*64+:64];
    wire [63:0] from_south_west = ~(has_west & south9) ? 64'd0
                                : lane == 0 ? north_corner_gift : south_east_corner[LAST*64+:64];

    // Sums of what arrives, up to position 12.
    logic [63:0] a10, b10, sum11, sum12, sa10, sb10, sc10, sab11, sc11, south12_sum;
    always_ff @(posedge clk)
      if (move) begin
        a10 <= added(south_north[lane*64+:64], from_south_west);
        b10 <= ENDS ? 64'd0 : south_corner[NEXT*64+:64];
        sum11 <= added(a10, b10);
        sum12 <= sum11;
        sa10 <= added(south9_sum, here_south[lane*64+:64]);
        sb10 <= added(from_west_axis, from_west_corner);
        sc10 <= ENDS ? 64'd0 : added(south_goes_west[NEXT*64+:64], here_corner[NEXT*64+:64]);
        sab11 <= added(sa10, sb10);
        sc11 <= sc10;
        south12_sum <= added(sab11, sc11);
      end
    assign to_south_east[lane*WORD+:WORD] = {packed_sum(sum12), pattern12, word12[CELL-1:0]};
    wire [WORD-1:0] turning = from_south_east[lane*WORD+:WORD];
    wire [63:0] turned_sum = added(unpacked(turning[WORD-1-:SOUTH]), ENDS ? south_corner[0+:64] : 64'd0);
    logic [WORD-1:0] turned;
    always_ff @(posedge clk) if (move) turned <= {packed_sum(turned_sum), turning[CELL+7:0]};
    assign to_north[lane*WORD+:WORD] = turned;

    // Lane P - 1 waits for the next block, and is finished then. The others are finished, and wait.
    logic [49:0] last_word, finished_word;
    if (lane == P - 1) begin : waits
      delay #(.WIDTH(192), .N(3)) gifts (
          .clk(clk), .en(move),
          .d({here_east[lane*64+:64], south_east_axis[lane*64+:64], south_east_corner[lane*64+:64]}),
          .q({corner12, axis12, north_corner12}));
      assign to_east = {south12_sum[SUM-1:0], left12, footing12, south12[CELL-1:0]};
      logic [63:0] late10, corner10, late11;
      logic [CELL+33:0] rest10, rest11;
      always_ff @(posedge clk)
        if (move) begin
          late10 <= added(64'(from_east[LATE-1-:SUM]), south_goes_west[0+:64]);
          corner10 <= here_corner[0+:64];
          rest10 <= from_east[CELL+33:0];
          late11 <= added(late10, corner10);
          rest11 <= rest10;
        end
      finish_unit #(.PRINTED(PRINTED)) finish (
          .clk(clk), .move(move), .stored(50'(rest11[CELL-1:0])), .footing(rest11[CELL+:2]),
          .left_amount(rest11[CELL+2+:16]), .left_energy(rest11[CELL+18+:16]), .amount_in(late11[15:0]),
          .energy_in(late11[31:16]), .content_in(late11[63:32]), .dither3(late3), .dither4(late4), .hot(hot),
          .printed(printed), .alpha(alpha), .finished(finished_word));
      assign last_word = finished_word;
    end else begin : ready
      finish_unit #(.PRINTED(PRINTED)) finish (
          .clk(clk), .move(move), .stored(south12), .footing(footing12), .left_amount(left12[15:0]),
          .left_energy(left12[31:16]), .amount_in(south12_sum[15:0]), .energy_in(south12_sum[31:16]),
          .content_in(south12_sum[63:32]), .dither3(early3), .dither4(early4), .hot(hot), .printed(printed),
          .alpha(alpha), .finished(finished_word));
      assign ready_cells[lane*CELL+:CELL] = finished_word[CELL-1:0];
      assign last_word = 50'(waited_cells[lane*CELL+:CELL]);
    end
    cell_of pack (
        .stored(last_word), .exposed_axes(2'd0), .pattern(8'd0), .beside_wall(1'b0), .touches(1'b0),
        .is_set(1'b0), .cell_out(out_cells[lane*67+:67]));
  end

  function automatic [1:0] footing_on(input [1:0] below);
    footing_on = below == voxmelt_pkg::SOLID ? 2'd1 : below == voxmelt_pkg::INERT ? 2'd2 : 2'd0;
  endfunction

  // The sum of what comes from the south, as memories have it: the content, if there is heat, stands highest.
  function automatic [SOUTH-1:0] packed_sum(input [63:0] sum);
    packed_sum = SOUTH'({sum[32+:PART+16], sum[16+:PART], sum[0+:PART]});
  endfunction
  function automatic [63:0] unpacked(input [SOUTH-1:0] kept);
    reg [3*PART+15:0] whole;
    begin
      whole = (3 * PART + 16)'(kept);
      unpacked = {32'(whole[2*PART+:PART+16]), 16'(whole[PART+:PART]), 16'(whole[0+:PART])};
    end
  endfunction

  function automatic [63:0] added(input [63:0] a, input [63:0] b);
    added = {a[63:32] + b[63:32], a[31:16] + b[31:16], a[15:0] + b[15:0]};
  endfunction
endmodule

// A gift that waits, as a sum of one.
module gift_memory #(
    parameter HOT = 1,
    parameter DEPTH = 4096
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        move,
    input  logic [23:0] delay,
    input  logic [63:0] gift,
    output logic [63:0] later
);
  localparam GIFT = HOT != 0 ? 58 : 28;
  wire [57:0] packed_gift = {gift[61:32], gift[29:16], gift[13:0]};
  logic [GIFT-1:0] waits;
  line_memory #(.WIDTH(GIFT), .DEPTH(DEPTH)) memory (
      .clk(clk), .rst(rst), .en(move), .delay(delay), .d(packed_gift[GIFT-1:0]), .q(waits));
  wire [57:0] whole = 58'(waits);
  assign later = {2'd0, whole[57:28], 2'd0, whole[27:14], 2'd0, whole[13:0]};
endmodule
