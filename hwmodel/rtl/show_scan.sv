// The third scan of settle, of one lane (docs/automaton.md, section 10). It goes up, and gives every cell its
// amount and its heat, and cells in a run what they show. Register 1 is that of the reverser.
//
// The loops are what a run still has for the cells above: one subtraction, and one addition.
module show_scan #(
    parameter SUM = 28,
    parameter LAST = 12,
    parameter MATERIALS = 0
) (
    input  logic                 clk,
    input  logic                 move,
    input  logic [SUM+LAST+35:0] word1,     // {set, mean heat, heat, cells less one, sum or amount, kind}
    input  logic [11:0]          y10,       // of the word in register 10
    input  logic [35:0]          pace10,    // of its pass: the mobility of one sub-step
    input  logic                 hot,
    input  logic                 thermal,
    input  logic [15:0]          mobility_reference,
    input  logic [15:0]          mobility_rate,
    input  logic [23:0]          yield_stress,
    input  logic [3:0]           stiffness,
    input  logic [(48<<MATERIALS)-1:0] beds,
    output voxmelt_pkg::cell_t   cell_out,  // in register 39, as those below
    output logic                 in_run,
    output logic [91:0]          shows      // {shut, dead, limit, mobility, head}, in a run
);
  localparam [2:0] SOLID = 3'd0, OUTSIDE = 3'd2, FIRST = 3'd4, SHUT = 3'd7;
  localparam AT_LAST = 3 + SUM, AT_HEAT = AT_LAST + LAST, AT_MEAN = AT_HEAT + 16, AT_SET = AT_MEAN + 16;
  localparam WORD = SUM + LAST + 36;
  localparam signed [SUM+1:0] OVER = 61439;  // the most that a cell holds beyond ONE

  // Registers 2 to 10: the bed, and what the run has beyond full cells.
  logic [WORD-1:0] word6, word10;
  logic [13:0] rise10, rise11;
  bed_unit #(.MATERIALS(MATERIALS)) bed (
      .clk(clk), .en(move), .solid(word1[2:0] == SOLID), .amount(word1[3+:16]), .heat(word1[AT_HEAT+:16]),
      .material(word1[19+:4]), .hot(hot), .beds(beds), .rise(rise10));
  delay #(.WIDTH(WORD), .N(5)) early (.clk(clk), .en(move), .d(word1), .q(word6));
  delay #(.WIDTH(WORD), .N(4)) late (.clk(clk), .en(move), .d(word6), .q(word10));
  wire [LAST-1:0] last6 = word6[AT_LAST+:LAST];
  wire [SUM-13:0] cells6 = (SUM - 12)'(last6) + (SUM - 12)'(1);
  logic signed [SUM:0] excess7;
  logic [LAST+15:0] most7, most8;  // OVER x last, by two shifts and two subtractions
  logic [LAST-1:0] last7;
  logic [SUM-1:0] over8, over9, over10;
  logic signed [SUM+1:0] spare9, spare10;

  // Register 11: the loops.
  wire [2:0] kind10 = word10[2:0];
  wire lowest10 = (kind10 == FIRST) | (kind10 == SHUT);
  logic [SUM-1:0] level11;
  logic signed [SUM+1:0] spare11;
  wire [SUM-1:0] level10_now = lowest10 ? word10[3+:SUM] : level11;
  wire signed [SUM+1:0] spare10_now = lowest10 ? spare10 : spare11;
  logic [12:0] base11;
  logic [15:0] more11, amount11, heat11, amount12, heat12;
  logic [2:0] kind11, kind12;
  logic set11, set12, lowest11, lowest12;
  wire blocked12 = kind12[2:1] == 2'd0, outside12 = kind12 == OUTSIDE;
  wire holds12 = amount12 != 16'd0;

  // What the run shows, from register 10 to 38. The cells wait.
  logic [29:0] head38;
  logic [21:0] mobility38;
  logic [13:0] limit38;
  logic [24:0] dead38;
  show_unit #(.SUM(SUM)) show (
      .clk(clk), .en(move), .sum(word10[3+:SUM]), .over(over10), .y(y10),
      .rise(y10 == 12'd0 ? 14'd512 : rise11), .mean(word10[AT_MEAN+:16]), .pace(pace10), .thermal(thermal),
      .mobility_reference(mobility_reference), .mobility_rate(mobility_rate), .yield_stress(yield_stress),
      .stiffness(stiffness), .head(head38), .mobility(mobility38), .limit(limit38), .dead(dead38));
  logic [38:0] cell13, cell38;  // {shut, lowest, set, in a run, blocked, heat, amount, state}
  delay #(.WIDTH(39), .N(25)) waits (.clk(clk), .en(move), .d(cell13), .q(cell38));
  logic [3:0] material38;  // of a solid, which has it in place of energy
  if (MATERIALS != 0) begin : many
    delay #(.WIDTH(4), .N(28)) numbers (
        .clk(clk), .en(move), .d(word10[2:0] == SOLID ? word10[19+:4] : 4'd0), .q(material38));
  end else begin : one
    assign material38 = 4'd0;
  end
  wire run38 = cell38[35], lowest38 = cell38[37];
  logic [91:0] run39;  // what the run shows that was begun last
  logic run_out;
  assign in_run = run_out;
  assign shows = run_out ? run39 : 92'd0;

  always_ff @(posedge clk)
    if (move) begin
      excess7 <= $signed({1'b0, word6[3+:SUM]}) - $signed({1'b0, cells6, 12'd0});
      most7 <= {last6, 16'd0} - {4'd0, last6, 12'd0};
      last7 <= last6;
      over8 <= excess7[SUM] ? '0 : excess7[SUM-1:0];
      most8 <= most7 - {16'd0, last7};
      spare9 <= $signed({2'd0, over8}) - $signed((SUM + 2)'(most8));
      over9 <= over8;
      spare10 <= spare9;  // at most OVER, as no cell holds more than AMAX
      over10 <= over9;

      rise11 <= rise10;
      level11 <= level10_now[SUM-1:12] == '0 ? '0 : {level10_now[SUM-1:12] - (SUM - 12)'(1), level10_now[11:0]};
      spare11 <= ~spare10_now[SUM+1] & (spare10_now != '0) ? OVER : spare10_now + OVER;
      base11 <= level10_now[SUM-1:12] != '0 ? 13'd4096 : level10_now[12:0];
      more11 <= spare10_now[SUM+1] ? 16'd0 : spare10_now[15:0];
      kind11 <= kind10;
      lowest11 <= lowest10;
      amount11 <= word10[3+:16];
      heat11 <= word10[AT_HEAT+:16];
      set11 <= word10[AT_SET];

      kind12 <= kind11;
      lowest12 <= lowest11;
      amount12 <= kind11[2] | (kind11[1:0] == 2'd3) ? 16'(base11) + more11 : amount11;
      heat12 <= heat11;
      set12 <= set11;

      cell13[1:0] <= blocked12 ? (kind12 == SOLID ? voxmelt_pkg::SOLID : voxmelt_pkg::INERT)
                   : holds12 ? voxmelt_pkg::LIQUID : voxmelt_pkg::AIR;
      cell13[17:2] <= amount12;
      cell13[33:18] <= blocked12 | holds12 ? heat12 : 16'd0;
      cell13[34] <= blocked12;
      cell13[35] <= ~blocked12 & ~outside12 & holds12;
      cell13[36] <= set12;
      cell13[37] <= lowest12;
      cell13[38] <= kind12 == SHUT;

      run_out <= run38;
      if (lowest38) run39 <= {cell38[38], dead38, limit38, mobility38, head38};
      cell_out <= '0;
      cell_out.state <= cell38[1:0];
      cell_out.amount <= cell38[17:2];
      cell_out.heat <= cell38[33:18];
      cell_out.is_set <= cell38[36];
      cell_out.energy <= {12'd0, material38};
    end
endmodule
