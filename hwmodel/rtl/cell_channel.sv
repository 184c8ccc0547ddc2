// A channel between two stages. It stores what the scene has of a cell: heat, and the side bands of its
// producer.
module cell_channel #(
    parameter P = 1,
    parameter HOT = 1,
    parameter ENERGY = 16,  // bits of the energy; a solid has its material there
    parameter AXES = 0,
    parameter PATTERN = 0,
    parameter WALL = 0,
    parameter TOUCHES = 0,
    parameter SET = 0,
    parameter RUN = 0,    // is the cell in a run?
    parameter SHOWS = 0,  // and what it shows
    parameter DEPTH = 4
) (
    input  logic            clk,
    input  logic            rst,
    input  logic            in_valid,
    output logic            in_ready,
    input  logic [P*67-1:0] in_cells,
    input  logic [P-1:0]    in_runs,
    input  logic [P*92-1:0] in_shows,
    output logic            out_valid,
    input  logic            out_ready,
    output logic [P*67-1:0] out_cells,
    output logic [P-1:0]    out_runs,
    output logic [P*92-1:0] out_shows
);
  localparam CELL = 18 + ENERGY + (HOT != 0 ? 16 : 0);
  localparam AT_PATTERN = CELL + 2 * AXES, AT_WALL = AT_PATTERN + 8 * PATTERN, AT_TOUCHES = AT_WALL + WALL,
             AT_SET = AT_TOUCHES + TOUCHES, AT_RUN = AT_SET + SET, AT_SHOWS = AT_RUN + RUN,
             WORD = AT_SHOWS + 92 * SHOWS;
  logic [P*WORD-1:0] in_word, out_word;
  channel #(.WIDTH(P * WORD), .DEPTH(DEPTH)) tokens (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_word(in_word),
      .out_valid(out_valid), .out_ready(out_ready), .out_word(out_word));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    wire [66:0] from = in_cells[lane*67+:67];
    wire [WORD-1:0] word = out_word[lane*WORD+:WORD];
    assign in_word[lane*WORD+:18] = from[17:0];
    assign out_cells[lane*67+:18] = word[17:0];
    assign out_cells[lane*67+50+:4] = 4'd0;
    if (ENERGY != 0) begin : energy
      assign in_word[lane*WORD+18+:ENERGY] = from[18+:ENERGY];
      assign out_cells[lane*67+18+:16] = 16'(word[18+:ENERGY]);
    end else begin : no_energy
      assign out_cells[lane*67+18+:16] = 16'd0;
    end
    if (HOT != 0) begin : heat
      assign in_word[lane*WORD+18+ENERGY+:16] = from[49:34];
      assign out_cells[lane*67+34+:16] = word[18+ENERGY+:16];
    end else begin : no_heat
      assign out_cells[lane*67+34+:16] = 16'd0;
    end
    if (AXES != 0) begin : axes
      assign in_word[lane*WORD+CELL+:2] = from[55:54];
      assign out_cells[lane*67+54+:2] = word[CELL+:2];
    end else begin : no_axes
      assign out_cells[lane*67+54+:2] = 2'd0;
    end
    if (PATTERN != 0) begin : pattern
      assign in_word[lane*WORD+AT_PATTERN+:8] = from[63:56];
      assign out_cells[lane*67+56+:8] = word[AT_PATTERN+:8];
    end else begin : no_pattern
      assign out_cells[lane*67+56+:8] = 8'd0;
    end
    if (WALL != 0) begin : wall
      assign in_word[lane*WORD+AT_WALL] = from[64];
      assign out_cells[lane*67+64] = word[AT_WALL];
    end else begin : no_wall
      assign out_cells[lane*67+64] = 1'b0;
    end
    if (TOUCHES != 0) begin : touches
      assign in_word[lane*WORD+AT_TOUCHES] = from[65];
      assign out_cells[lane*67+65] = word[AT_TOUCHES];
    end else begin : no_touches
      assign out_cells[lane*67+65] = 1'b0;
    end
    if (SET != 0) begin : is_set
      assign in_word[lane*WORD+AT_SET] = from[66];
      assign out_cells[lane*67+66] = word[AT_SET];
    end else begin : not_set
      assign out_cells[lane*67+66] = 1'b0;
    end
    if (RUN != 0) begin : run
      assign in_word[lane*WORD+AT_RUN] = in_runs[lane];
      assign out_runs[lane] = word[AT_RUN];
    end else begin : no_run
      assign out_runs[lane] = 1'b0;
    end
    if (SHOWS != 0) begin : show
      assign in_word[lane*WORD+AT_SHOWS+:92] = in_shows[lane*92+:92];
      assign out_shows[lane*92+:92] = word[AT_SHOWS+:92];
    end else begin : no_show
      assign out_shows[lane*92+:92] = 92'd0;
    end
  end
endmodule
