// The second scan of settle, of one lane (docs/automaton.md, section 10). It goes down, takes the record of a
// run to the run's first cell, and moves down what is missing below. Register 1 is that of the reverser.
//
// What a run has above a cell, and what flows down to it, are two loops of one addition each. Heat that moves
// down needs a division before the next cell can come, so it waits.
//
// A word is {set, mean heat, amount at the top, ordered, heat, cells less one, sum or amount, kind} when it
// comes, and {set, mean heat, heat, cells less one, sum or amount, kind} when it leaves.
module record_scan #(
    parameter SUM = 28,
    parameter LAST = 12
) (
    input  logic                 clk,
    input  logic                 rst,
    input  logic                 move,
    input  logic [SUM+LAST+52:0] word1,
    input  logic                 highest1,  // of its column
    input  logic                 live6,     // a word of a column is in register 6
    input  logic [15:0]          dither6,   // of its pass
    output logic                 works,     // no move is possible
    output logic [SUM+LAST+35:0] word7
);
  localparam [2:0] INNER = 3'd3, FIRST = 3'd4, TOP = 3'd5, SINGLE = 3'd6, SHUT = 3'd7;
  localparam AT_LAST = 3 + SUM, AT_HEAT = AT_LAST + LAST, AT_ORDERED = AT_HEAT + 16, AT_TOP = AT_ORDERED + 1,
             AT_MEAN = AT_TOP + 16, AT_SET = AT_MEAN + 16;
  localparam signed [SUM:0] LEAST = 4032, MOST = 4160;  // of a run that is full, less ONE for all cells but one

  // Registers 2 and 3: what the run has beyond full cells, but for the uppermost. Is the run shut?
  logic [SUM+LAST+52:0] word2, word3, word4, word5;
  logic signed [SUM:0] start2, start3;
  logic highest2, highest3, full3, shut4, shut5;
  wire blocked4 = word4[2:1] == 2'd0;

  // Register 4: the loop of levels. `keeps` is what a cell has in the end.
  logic signed [SUM:0] level4;
  logic [12:0] keeps4;
  logic [15:0] amount4;
  wire is_top3 = word3[2:0] == TOP, is_top5 = word5[2:0] == TOP;
  wire signed [SUM:0] level3 = is_top3 ? start3 : level4;

  // Register 6: the loop of what flows down from each cell, and the record of the run.
  logic signed [17:0] gives5, flow6;
  wire signed [17:0] comes5 = is_top5 ? 18'sd0 : flow6;
  logic [15:0] amount5, amount6, comes6, heat6, record_heat6;
  logic [SUM-1:0] sum6, record_sum6;
  logic [LAST-1:0] last6, record_last6;
  logic [15:0] mean6, record_mean6;
  logic [2:0] kind6;
  logic record_shut6, ordered6, set6, shut6;
  wire of_run6 = (kind6 == TOP) | (kind6 == INNER) | (kind6 == FIRST);

  // Register 7: the loop of heat.
  logic [15:0] warmth7, mixed;
  wire turns = live6 & of_run6 & ordered6 & (comes6 != 16'd0);
  serial_mixer sinking (
      .clk(clk), .rst(rst), .start(turns), .move(move), .amount(amount6), .heat(heat6), .flow(comes6),
      .flow_heat(warmth7), .dither(dither6), .works(works), .mixed(mixed));
  wire [15:0] own6 = turns ? mixed : heat6;
  wire inner6 = (kind6 == TOP) | (kind6 == INNER), first6 = kind6 == FIRST, single6 = kind6 == SINGLE;

  always_ff @(posedge clk)
    if (move) begin
      word2 <= word1;
      highest2 <= highest1;
      start2 <= $signed({1'b0, word1[3+:SUM]}) - $signed({1'b0, SUM'({word1[AT_LAST+:LAST], 12'd0})});

      word3 <= word2;
      highest3 <= highest2;
      start3 <= start2;
      full3 <= (start2 >= LEAST) & (start2 <= MOST);

      word4 <= word3;
      shut4 <= full3 & (highest3 | blocked4);
      level4 <= level3 + $signed({{(SUM - 15) {1'b0}}, voxmelt_pkg::ONE});
      keeps4 <= level3[SUM] ? 13'd0 : level3[SUM-1:12] != '0 ? 13'd4096 : level3[12:0];
      amount4 <= is_top3 ? word3[AT_TOP+:16] : word3[3+:16];

      word5 <= word4;
      shut5 <= shut4;
      amount5 <= amount4;
      gives5 <= $signed({2'b0, amount4}) - $signed({5'd0, keeps4});

      kind6 <= word5[2:0];
      sum6 <= word5[3+:SUM];
      last6 <= word5[AT_LAST+:LAST];
      heat6 <= word5[AT_HEAT+:16];
      mean6 <= word5[AT_MEAN+:16];
      set6 <= word5[AT_SET];
      shut6 <= shut5;
      amount6 <= amount5;
      comes6 <= comes5[15:0];
      flow6 <= comes5 + gives5;
      if (is_top5) begin
        record_sum6 <= word5[3+:SUM];
        record_last6 <= word5[AT_LAST+:LAST];
        record_heat6 <= word5[AT_HEAT+:16];
        record_mean6 <= word5[AT_MEAN+:16];
        record_shut6 <= shut5;
        ordered6 <= word5[AT_ORDERED];
      end

      warmth7 <= own6;
      word7[2:0] <= inner6 ? INNER : first6 ? (record_shut6 ? SHUT : FIRST)
                  : single6 ? (shut6 ? SHUT : FIRST) : kind6;
      word7[3+:SUM] <= inner6 ? '0 : first6 ? record_sum6 : sum6;
      word7[AT_LAST+:LAST] <= inner6 ? '0 : first6 ? record_last6 : last6;
      word7[AT_HEAT+:16] <= ~of_run6 ? heat6 : ordered6 ? own6 : record_heat6;
      word7[AT_HEAT+16+:16] <= first6 ? record_mean6 : single6 ? mean6 : 16'd0;
      word7[AT_HEAT+32] <= set6;
    end
endmodule
