// The stage pattern: the directions that each cell gives to (paper law). A window of four cells completes the
// pairs of the cell that comes and its south; the pairs along x are those of the plane before.
//
// A word in register 1 is at position 0. Its limits are known at position 7. Its south is then as far on its
// way behind the plane memory.
module pattern_stage #(
    parameter P = 1,  // 1, 2, 4, 8 or 16
    parameter HOT = 1,
    parameter DEPTH_SOUTH_EAST = 4096,  // of the memories: the longest delay, less one
    parameter DEPTH_NORTH = 32768,
    parameter DEPTH_EAST = 4096
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
    input  logic [23:0]         south_east,   // lengths of the three memories
    input  logic [23:0]         north,
    input  logic [23:0]         east,
    input  logic [319:0]        keys,
    input  logic [31:0]         row_blocks,   // random blocks of a row
    input  logic [31:0]         plane_blocks,
    input  logic [511:0]        shares,
    input  logic                eight,
    input  logic                support,
    input  logic                downhill,
    input  logic                gives_shares,
    input  logic [15:0]         threshold,
    input  logic [15:0]         margin,
    input  logic [15:0]         slump,
    input  logic [19:0]         margin_diagonal,
    input  logic [19:0]         slump_diagonal
);
  localparam CELL = HOT != 0 ? 50 : 34;
  localparam EARLY = CELL + 3 + 16;   // {diagonal limit, south-east, south-west, south, cell}
  localparam PLANE = CELL + 3;
  localparam LATE = CELL + 8 + 32;    // {limits, pattern, cell}
  // Only the last lane's limits wait for another token.
  localparam EARLY_WORD = P * PLANE + 16, LATE_WORD = P * (CELL + 8) + 32;
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

  // What is known of the token at position 0, and at position 7.
  logic west0, south0, floor0, west7, south7;
  always_ff @(posedge clk)
    if (move) begin
      west0 <= came.block != 12'd0;
      south0 <= here & (came.plane != 12'd0);
      floor0 <= came.y == 12'd0;
    end
  delay #(.WIDTH(2), .N(7)) flags (.clk(clk), .en(move), .d({west0, south0}), .q({west7, south7}));

  logic [P*EARLY-1:0] to_south_east, from_south_east;
  logic [P*PLANE-1:0] to_north, from_north;
  logic [P*LATE-1:0] to_east, from_east;
  logic [EARLY_WORD-1:0] in_early, out_early;
  logic [LATE_WORD-1:0] in_late, out_late;
  line_memory #(.WIDTH(EARLY_WORD), .DEPTH(DEPTH_SOUTH_EAST)) early (
      .clk(clk), .rst(rst), .en(move), .delay(south_east), .d(in_early), .q(out_early));
  line_memory #(.WIDTH(P * PLANE), .DEPTH(DEPTH_NORTH)) planes (
      .clk(clk), .rst(rst), .en(move), .delay(north), .d(to_north), .q(from_north));
  line_memory #(.WIDTH(LATE_WORD), .DEPTH(DEPTH_EAST)) late (
      .clk(clk), .rst(rst), .en(move), .delay(east), .d(in_late), .q(out_late));
  assign in_early[P*PLANE+:16] = to_south_east[P*EARLY-1-:16];
  assign in_late[P*(CELL+8)+:32] = to_east[P*LATE-1-:32];
  for (genvar lane = 0; lane < P; lane++) begin : stored
    localparam [0:0] ENDS = lane == P - 1;
    assign in_early[lane*PLANE+:PLANE] = to_south_east[lane*EARLY+:PLANE];
    assign from_south_east[lane*EARLY+:EARLY] = {ENDS ? out_early[P*PLANE+:16] : 16'd0, out_early[lane*PLANE+:PLANE]};
    assign in_late[lane*(CELL+8)+:CELL+8] = to_east[lane*LATE+:CELL+8];
    assign from_east[lane*LATE+:LATE] = {ENDS ? out_late[P*(CELL+8)+:32] : 32'd0, out_late[lane*(CELL+8)+:CELL+8]};
  end

  // The random block of a token is begun 11 moves before the token can use it.
  voxmelt_pkg::place_t drawn;
  logic [31:0] drawn_step;
  place_behind draws (
      .clk(clk), .rst(rst), .move(move), .behind(lag - 24'd12), .fill(fill), .drained(drained), .last(last),
      .step_came(step_came), .place(drawn), .step(drawn_step));
  logic [31:0] row, base, index, index_step;
  localparam SHIFT = P == 1 ? 3 : P == 2 ? 2 : P == 4 ? 1 : 0, TWICE = P == 16 ? 1 : 0;
  wire [31:0] base_now = drawn == '0 ? 32'd0 : base;
  wire [31:0] row_now = drawn.y == 12'd0 ? base_now : row;
  wire ends_plane = (drawn.y == last.y) & (drawn.block == last.block);
  logic [2:0] part, part11;  // of a block of 8, where lane 0 is
  always_ff @(posedge clk)
    if (move) begin
      index <= row_now + ((32'(drawn.block) >> SHIFT) << TWICE);
      index_step <= drawn_step;
      row <= row_now + row_blocks;
      base <= ends_plane ? base_now + plane_blocks : base_now;
      part <= 3'(drawn.block * 12'(P));
    end
  delay #(.WIDTH(3), .N(10)) parts (.clk(clk), .en(move), .d(part), .q(part11));
  logic [63:0] random, random_high;  // the second one serves lanes 8 to 15
  speck_unit block_of (
      .clk(clk), .move(move), .keys(keys), .step(index_step), .index(index), .block(random));
  if (P == 16) begin : second
    speck_unit next_block (
        .clk(clk), .move(move), .keys(keys), .step(index_step), .index(index + 32'd1), .block(random_high));
  end else begin : same
    assign random_high = random;
  end

  logic [P*50-1:0] words0;              // that came, and those behind the plane memory
  logic [P*49-1:0] sides7, souths7;     // {diagonal limit, axis limit, amount, blocked}
  wire [48:0] west_side = {from_south_east[P*EARLY-1-:16], 16'd0, from_south_east[(P-1)*EARLY+2+:16],
                           from_south_east[(P-1)*EARLY+1]};
  wire [48:0] south_west_side = {from_east[P*LATE-1-:32], from_east[(P-1)*LATE+2+:16], from_east[(P-1)*LATE+1]};
  logic [P-1:0] here_south, south_north, south_goes_west, south_west_east, here_south_west,
                south_west_north_east, west_south_east, south_north_west;

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    localparam NEXT = (lane + 1) % P, LAST = (lane + P - 1) % P;
    localparam [0:0] ENDS = lane == P - 1;  // its eastern cells are in another token
    logic [49:0] coded;
    coded_of code (.cell_in(in_cells[lane*67+:67]), .coded(coded));
    wire [49:0] south0_word = 50'(from_north[lane*PLANE+:CELL]);
    logic [49:0] word1, south1_word, word7, south7_word;
    logic [2:0] south7_pattern;
    always_ff @(posedge clk)
      if (move) begin
        words0[lane*50+:50] <= here ? coded : voxmelt_pkg::BORDER;
        word1 <= words0[lane*50+:50];
        south1_word <= south0_word;
      end
    delay #(.WIDTH(50), .N(6)) waits (.clk(clk), .en(move), .d(word1), .q(word7));
    delay #(.WIDTH(50), .N(6)) south_waits (.clk(clk), .en(move), .d(south1_word), .q(south7_word));
    delay #(.WIDTH(3), .N(7)) pattern_waits (
        .clk(clk), .en(move), .d(from_north[lane*PLANE+CELL+:3]), .q(south7_pattern));

    logic [15:0] axis7, diagonal7, south_axis7, south_diagonal7;
    limit_unit limit (
        .clk(clk), .move(move), .stored(words0[lane*50+:50]), .air_below(~floor0 & holds_air(word1)),
        .shares(shares), .eight(eight), .support(support), .downhill(downhill), .gives_shares(gives_shares),
        .threshold(threshold), .margin(margin), .slump(slump), .margin_diagonal(margin_diagonal),
        .slump_diagonal(slump_diagonal), .axis(axis7), .diagonal(diagonal7));
    limit_unit south_limit (
        .clk(clk), .move(move), .stored(south0_word), .air_below(~floor0 & holds_air(south1_word)),
        .shares(shares), .eight(eight), .support(support), .downhill(downhill), .gives_shares(gives_shares),
        .threshold(threshold), .margin(margin), .slump(slump), .margin_diagonal(margin_diagonal),
        .slump_diagonal(slump_diagonal), .axis(south_axis7), .diagonal(south_diagonal7));
    assign sides7[lane*49+:49] = {diagonal7, axis7, word7[17:2], word7[1]};
    assign souths7[lane*49+:49] = {south_diagonal7, south_axis7, south7_word[17:2], south7_word[1]};

    offer_unit offers (
        .here(sides7[lane*49+:49]), .west(lane == 0 ? west_side : sides7[LAST*49+:49]),
        .south(souths7[lane*49+:49]), .south_west(lane == 0 ? south_west_side : souths7[LAST*49+:49]),
        .has_west(lane == 0 ? west7 : 1'b1), .has_south(south7), .eight(eight),
        .here_south(here_south[lane]), .south_north(south_north[lane]),
        .south_goes_west(south_goes_west[lane]), .south_west_east(south_west_east[lane]),
        .here_south_west(here_south_west[lane]), .south_west_north_east(south_west_north_east[lane]),
        .west_south_east(west_south_east[lane]), .south_north_west(south_north_west[lane]));

    // A lane knows by its eastern neighbour's window what it gives there. Lane P - 1 knows it a column later.
    logic [EARLY-1:0] word8;
    logic [LATE-1:0] south8;
    wire south_east_now = ENDS ? 1'b0 : west_south_east[NEXT];
    wire east_now = ENDS ? 1'b0 : south_west_east[NEXT];
    wire north_east_now = ENDS ? 1'b0 : south_west_north_east[NEXT];
    always_ff @(posedge clk)
      if (move) begin
        word8 <= {diagonal7, south_east_now, here_south_west[lane], here_south[lane], word7[CELL-1:0]};
        south8 <= {south_diagonal7, south_axis7,
                   south7_pattern[1], south_north_west[lane], south7_pattern[2], north_east_now,
                   south7_pattern[0], south_north[lane], south_goes_west[lane], east_now,
                   south7_word[CELL-1:0]};
      end
    assign to_south_east[lane*EARLY+:EARLY] = word8;
    assign to_east[lane*LATE+:LATE] = south8;
    wire south_east_then = ENDS & west_south_east[0];
    assign to_north[lane*PLANE+:PLANE] =
        from_south_east[lane*EARLY+:PLANE] | {south_east_then, {(PLANE - 1) {1'b0}}};

    // Draws a subset of the directions.
    wire [7:0] full = from_east[lane*LATE+CELL+:8]
                    | {3'd0, ENDS & south_west_north_east[0], 3'd0, ENDS & south_west_east[0]};
    wire [2:0] byte_at = part11 + 3'(lane);
    wire [7:0] allowed = lane >= 8 ? random_high[{byte_at, 3'd0}+:8] : random[{byte_at, 3'd0}+:8];
    logic [49:0] word;
    logic [7:0] pattern;
    always_ff @(posedge clk)
      if (move) begin
        word <= 50'(from_east[lane*LATE+:CELL]);
        pattern <= full & allowed;
      end
    cell_of pack (
        .stored({word[49:2], word[1:0] == voxmelt_pkg::AIR && word[17:2] != 16'd0 ? voxmelt_pkg::LIQUID : word[1:0]}),
        .exposed_axes(2'd0), .pattern(pattern), .beside_wall(1'b0), .touches(1'b0), .is_set(1'b0),
        .cell_out(out_cells[lane*67+:67]));
  end

  // A set cell has the state of air, and holds something.
  function automatic holds_air(input [49:0] word);
    holds_air = (word[1:0] == voxmelt_pkg::AIR) & (word[17:2] == 16'd0);
  endfunction
endmodule
