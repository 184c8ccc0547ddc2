// Counts the tokens of a stage, and says when it moves. A move takes a token, or after the last one of a pass
// the border. It gives the token that came `lag` moves before. So a stage empties itself.
//
// Passes may follow one another without a gap. Then the tokens of the next pass push out those of the last.
module stage_control (
    input  logic                clk,
    input  logic                rst,
    input  logic                in_valid,
    output logic                in_ready,
    output logic                out_valid,
    input  logic                out_ready,
    input  logic                hold,      // no move is possible: a divider works
    input  logic                follows,   // a pass comes directly behind the present one
    input  logic [31:0]         step,      // of the pass whose first token comes next
    input  voxmelt_pkg::place_t last,      // of a tile
    input  logic [23:0]         lag,       // at least 1, and no more than the tokens of a pass if one follows
    output logic                move,
    output logic                here,      // a token comes with this move
    output logic                overlaps,  // tokens of the last pass are under way
    output voxmelt_pkg::place_t came,      // place of the token that comes
    output voxmelt_pkg::place_t left,      // place of the token that leaves
    output logic [31:0]         step_came,
    output logic [31:0]         step_left,
    output logic [23:0]         fill,      // tokens under way, or lag
    output logic                drained    // the last one leaves with this move
);
  voxmelt_pkg::place_t at;
  logic all_came, draining, two;
  logic gives;  // `fill` is `lag`: a register, since all of the stage waits for `move`
  logic [31:0] step_now, step_last;

  wire next = all_came & follows & ~draining;
  assign here = ~all_came | next;
  assign in_ready = here & (~gives | out_ready) & ~hold;
  assign out_valid = gives & (~here | in_valid) & ~hold;
  assign move = (~here | in_valid) & (~gives | out_ready) & ~hold;

  assign came = next ? '0 : at;
  assign overlaps = two | next;
  wire first = here & (came == '0);
  wire ends = here & (came == last);
  wire gone = gives & (left == last);  // the last token of a pass leaves
  assign drained = gone & ~overlaps;
  assign step_came = first ? step : step_now;
  assign step_left = overlaps ? next ? step_now : step_last : step_now;

  voxmelt_pkg::place_t after_came, after_left;
  place_after came_after (.place(came), .last(last), .wraps(1'b0), .after(after_came));
  place_after left_after (.place(left), .last(last), .wraps(1'b1), .after(after_left));

  always_ff @(posedge clk)
    if (rst) begin
      at <= '0;
      left <= '0;
      all_came <= 1'b0;
      draining <= 1'b0;
      two <= 1'b0;
      gives <= 1'b0;
      fill <= '0;
    end else if (move) begin
      at <= drained ? '0 : after_came;
      all_came <= ~drained & (here ? ends : all_came);
      draining <= ~drained & ~here;
      two <= overlaps & ~gone;
      gives <= ~drained & (gives | (fill == lag - 24'd1));
      if (drained) fill <= '0;
      else if (~gives) fill <= fill + 24'd1;
      if (gives) left <= after_left;
      if (first) begin
        step_now <= step;
        step_last <= step_now;
      end
    end
endmodule

// Where the token is that came so many moves before, and its step.
module place_behind (
    input  logic                clk,
    input  logic                rst,
    input  logic                move,
    input  logic [23:0]         behind,     // at least 1, and at most lag
    input  logic [23:0]         fill,       // these are stage_control's
    input  logic                drained,
    input  voxmelt_pkg::place_t last,
    input  logic [31:0]         step_came,
    output voxmelt_pkg::place_t place,
    output logic [31:0]         step
);
  logic [31:0] step_now, step_kept;
  wire first = place == '0;
  assign step = first ? step_now : step_kept;
  voxmelt_pkg::place_t after;
  place_after next (.place(place), .last(last), .wraps(1'b1), .after(after));
  always_ff @(posedge clk) begin
    if (move) step_now <= step_came;
    if (rst) place <= '0;
    else if (move & drained) place <= '0;
    else if (move & (fill >= behind)) begin
      place <= after;
      step_kept <= step;
    end
  end
endmodule

// The place behind another one in the stream.
module place_after (
    input  voxmelt_pkg::place_t place,
    input  voxmelt_pkg::place_t last,
    input  logic                wraps,  // the first place comes behind the last
    output voxmelt_pkg::place_t after
);
  wire end_y = place.y == last.y;
  wire end_block = end_y & (place.block == last.block);
  wire end_plane = end_block & wraps & (place.plane == last.plane);
  assign after.y = end_y ? 12'd0 : place.y + 12'd1;
  assign after.block = end_block ? 12'd0 : place.block + 12'(end_y);
  assign after.plane = end_plane ? 12'd0 : place.plane + 12'(end_block);
endmodule
