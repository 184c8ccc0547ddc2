// The stage source: vents, then drains, then the open border, one after another.
//
// An opening is {until, from, energy, temperature, rate, radius squared, z, y, x}, 199 bits.
module source_stage #(
    parameter P = 1,
    parameter VENTS = 2,
    parameter DRAINS = 2
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
    input  logic [(VENTS+DRAINS>0?VENTS+DRAINS:1)*199-1:0] openings,  // vents first; without any, unused
    input  logic [11:0]         last_x,               // of the grid
    input  logic                open_border,
    input  logic                hot
);
  localparam N = VENTS + DRAINS;
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

  // The dither of a mixture in opening i is wanted 7 + 26 i + 5 moves after its cell came.
  logic [15:0] dither;
  dither_unit reverse (.step(step_came), .dither(dither));
  logic [(N+1)*16-1:0] dithers;
  delay #(.WIDTH(16), .N(12)) first_dither (.clk(clk), .en(move), .d(dither), .q(dithers[15:0]));
  logic [N:0] open;  // of the step of the token that comes
  for (genvar i = 0; i < N; i++) begin : steps
    delay #(.WIDTH(16), .N(26)) dither_of (
        .clk(clk), .en(move), .d(dithers[i*16+:16]), .q(dithers[(i+1)*16+:16]));
    assign open[i] = (step_came >= openings[i*199+135+:32]) & (step_came < openings[i*199+167+:32]);
  end
  wire edge_z = (came.plane == 12'd0) | (came.plane == last.plane);

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    logic [49:0] stored;
    stored_of unpack (.cell_in(in_cells[lane*67+:67]), .stored(stored));
    wire [11:0] x = 12'(came.block * 12'(P)) + 12'(lane);
    logic [(N+1)*50-1:0] words;
    delay #(.WIDTH(50), .N(7)) waits (.clk(clk), .en(move), .d(stored), .q(words[49:0]));
    for (genvar i = 0; i < N; i++) begin : each
      localparam AT = i * 199;
      logic inside_ball, open7, covers;
      ball_unit ball (
          .clk(clk), .move(move), .x(x), .y(came.y), .z(came.plane), .at_x($signed(openings[AT+:18])),
          .at_y($signed(openings[AT+18+:18])), .at_z($signed(openings[AT+36+:18])),
          .radius2(openings[AT+54+:36]), .inside_ball(inside_ball));
      delay #(.WIDTH(1), .N(7)) opens (.clk(clk), .en(move), .d(open[i]), .q(open7));
      if (i == 0) begin : first
        assign covers = inside_ball & open7;
      end else begin : later
        delay #(.WIDTH(1), .N(26 * i)) its_turn (.clk(clk), .en(move), .d(inside_ball & open7), .q(covers));
      end
      opening_lane #(.VENT(i < VENTS ? 1 : 0)) opening (
          .clk(clk), .move(move), .stored(words[i*50+:50]), .covers(covers), .rate(openings[AT+90+:16]),
          .temperature(openings[AT+106+:16]), .energy(openings[AT+122+:13]), .hot(hot),
          .dither5(dithers[i*16+:16]), .treated(words[(i+1)*50+:50]));
    end

    logic at_edge;
    delay #(.WIDTH(1), .N(26 * N + 7)) edges (
        .clk(clk), .en(move), .d(open_border & (edge_z | (x == 12'd0) | (x == last_x))), .q(at_edge));
    wire [49:0] whole = words[N*50+:50];
    wire empty = ~whole[1] & (at_edge | (whole[17:2] == 16'd0));
    logic [49:0] word;
    always_ff @(posedge clk)
      if (move)
        word <= whole[1] ? whole : empty ? {48'd0, voxmelt_pkg::AIR} : {whole[49:2], voxmelt_pkg::LIQUID};
    cell_of pack (
        .stored(word), .exposed_axes(2'd0), .pattern(8'd0), .beside_wall(1'b0), .touches(1'b0), .is_set(1'b0),
        .cell_out(out_cells[lane*67+:67]));
  end
endmodule
