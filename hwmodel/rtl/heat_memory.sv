// A line memory for the words of a pass of heat. It stores what the scene has of a word: {touches, beside_wall,
// axes, temperature, heat, energy, amount, state}.
module heat_memory #(
    parameter P = 1,
    parameter MOST = 3,      // bits of the axes in a word
    parameter AXES = 3,      // and those that are stored: MOST, or 0
    parameter WALL = 1,
    parameter TOUCHES = 1,
    parameter ENERGY = 16,   // bits of the energy that are stored
    parameter DEPTH = 4096   // the longest delay, less one
) (
    input  logic                   clk,
    input  logic                   rst,
    input  logic                   en,
    input  logic [23:0]            delay,
    input  logic [P*(68+MOST)-1:0] d,
    output logic [P*(68+MOST)-1:0] q
);
  localparam FULL = 68 + MOST, AT_HEAT = 18 + ENERGY, AT_AXES = AT_HEAT + 32, AT_WALL = AT_AXES + AXES,
             AT_TOUCHES = AT_WALL + WALL, WORD = AT_TOUCHES + TOUCHES;
  logic [P*WORD-1:0] in_words, out_words;
  line_memory #(.WIDTH(P * WORD), .DEPTH(DEPTH)) memory (
      .clk(clk), .rst(rst), .en(en), .delay(delay), .d(in_words), .q(out_words));

  for (genvar lane = 0; lane < P; lane++) begin : lanes
    wire [FULL-1:0] full = d[lane*FULL+:FULL];
    wire [WORD-1:0] word = out_words[lane*WORD+:WORD];
    assign in_words[lane*WORD+:18] = full[17:0];
    assign in_words[lane*WORD+AT_HEAT+:32] = full[65:34];
    assign q[lane*FULL+:18] = word[17:0];
    assign q[lane*FULL+34+:32] = word[AT_HEAT+:32];
    if (ENERGY != 0) begin : energy
      assign in_words[lane*WORD+18+:ENERGY] = full[18+:ENERGY];
      assign q[lane*FULL+18+:16] = 16'(word[18+:ENERGY]);
    end else begin : no_energy
      assign q[lane*FULL+18+:16] = 16'd0;
    end
    if (AXES != 0) begin : axes
      assign in_words[lane*WORD+AT_AXES+:AXES] = full[66+:AXES];
      assign q[lane*FULL+66+:MOST] = word[AT_AXES+:AXES];
    end else begin : no_axes
      assign q[lane*FULL+66+:MOST] = '0;
    end
    if (WALL != 0) begin : wall
      assign in_words[lane*WORD+AT_WALL] = full[66+MOST];
      assign q[lane*FULL+66+MOST] = word[AT_WALL];
    end else begin : no_wall
      assign q[lane*FULL+66+MOST] = 1'b0;
    end
    if (TOUCHES != 0) begin : touches
      assign in_words[lane*WORD+AT_TOUCHES] = full[67+MOST];
      assign q[lane*FULL+67+MOST] = word[AT_TOUCHES];
    end else begin : no_touches
      assign q[lane*FULL+67+MOST] = 1'b0;
    end
  end
endmodule
