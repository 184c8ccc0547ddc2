// What a run shows to its neighbours, from its record (docs/automaton.md, section 10). Nothing returns, so all
// of it may have registers: three divisions and products among them.
module show_unit #(
    parameter SUM = 28
) (
    input  logic            clk,
    input  logic            en,
    input  logic [SUM-1:0]  sum,
    input  logic [SUM-1:0]  over,       // of it, beyond full cells
    input  logic [11:0]     y,          // of the run's first cell
    input  logic [13:0]     rise,       // of the bed
    input  logic [15:0]     mean,       // heat
    input  logic [35:0]     pace,       // the mobility of one sub-step
    input  logic            thermal,    // it depends on heat
    input  logic [15:0]     mobility_reference,
    input  logic [15:0]     mobility_rate,
    input  logic [23:0]     yield_stress,
    input  logic [3:0]      stiffness,
    output logic [29:0]     head,       // signed; these are 28 moves later
    output logic [21:0]     mobility,
    output logic [13:0]     limit,
    output logic [24:0]     dead
);
  // The head.
  logic signed [29:0] bed1, level2, level3, head4;
  logic [SUM-4:0] depth1;
  logic signed [SUM+14:0] pressed3;
  product #(.B(SUM - 3)) pressure (
      .clk(clk), .en(en), .a($signed({14'd0, stiffness}) - 18'sd1), .b(over[SUM-1:3]), .p(pressed3));
  delay #(.WIDTH(30), .N(24)) heads (.clk(clk), .en(en), .d(head4), .q(head));

  // The limit: 13107 / cells, or by stiffness where the run is under pressure. A divisor that is larger than
  // 13107 gives 0, and so the least limit.
  logic [SUM-12:0] cells1;
  logic [3:0] factor1;
  logic signed [SUM+6:0] by4;
  logic [13:0] by5, limit19, limit20;
  product #(.B(SUM - 11)) stiff (.clk(clk), .en(en), .a($signed({14'd0, factor1})), .b(cells1), .p(by4));
  logic [14*14-1:0] unused_divisors;
  logic signed [14:0] unused_rest;
  divider #(.REST(14), .QUOTIENT(14), .NUMBER(15)) of_limit (
      .clk(clk), .en(en), .number(15'd13107), .by(by5), .divisors(unused_divisors), .quotient(limit19),
      .rest(unused_rest));
  delay #(.WIDTH(14), .N(8)) limits (.clk(clk), .en(en), .d(limit20), .q(limit));

  // The dead zone.
  localparam DEPTH = SUM - 4;
  logic [DEPTH-1:0] deep1, deep2;
  logic [25:0] number2;
  logic [25*DEPTH-1:0] unused_depths;
  logic signed [DEPTH:0] unused_part;
  logic [24:0] dead27;
  divider #(.REST(DEPTH), .QUOTIENT(25), .NUMBER(26)) of_yield (
      .clk(clk), .en(en), .number(number2), .by(deep2), .divisors(unused_depths), .quotient(dead27),
      .rest(unused_part));

  // The mobility: the square of what the run holds, pace, and the power of heat.
  logic big1, big4;
  logic [17:0] capped1;
  logic [35:0] square4, pace5;
  logic [28:0] square5;
  logic [46:0] low8, high8, low9, high9, raw10;
  logic [39:0] raw13;
  logic [12:0] power13;
  logic [5:0] shift13, shift17;
  logic [3:0] shift18;
  logic [1:0] shift19;
  logic [32:0] low16, high16;
  logic [52:0] warm17, warm18;
  logic [36:0] warm19;
  logic [24:0] warm20;
  logic [21:0] mobility21;
  long_product #(.A(18), .B(18)) squares (.clk(clk), .en(en), .a(capped1), .b(capped1), .p(square4));
  delay #(.WIDTH(1), .N(3)) caps (.clk(clk), .en(en), .d(big1), .q(big4));
  delay #(.WIDTH(36), .N(5)) paces (.clk(clk), .en(en), .d(pace), .q(pace5));
  long_product #(.A(29), .B(18)) low_half (.clk(clk), .en(en), .a(square5), .b(pace5[17:0]), .p(low8));
  long_product #(.A(29), .B(18)) high_half (.clk(clk), .en(en), .a(square5), .b(pace5[35:18]), .p(high8));
  delay #(.WIDTH(40), .N(3)) raws (.clk(clk), .en(en), .d(raw10[45:6]), .q(raw13));
  warm_unit warm (
      .clk(clk), .en(en), .mean(mean), .thermal(thermal), .reference(mobility_reference), .rate(mobility_rate),
      .power(power13), .shift(shift13));
  long_product #(.A(20), .B(13)) low_power (.clk(clk), .en(en), .a(raw13[19:0]), .b(power13), .p(low16));
  long_product #(.A(20), .B(13)) high_power (.clk(clk), .en(en), .a(raw13[39:20]), .b(power13), .p(high16));
  delay #(.WIDTH(6), .N(4)) shifts (.clk(clk), .en(en), .d(shift13), .q(shift17));
  delay #(.WIDTH(22), .N(7)) mobilities (.clk(clk), .en(en), .d(mobility21), .q(mobility));

  always_ff @(posedge clk)
    if (en) begin
      bed1 <= $signed({16'd0, rise}) + $signed({9'd0, y, 9'd0}) - 30'sd512;
      depth1 <= sum[SUM-1:3];
      level2 <= bed1 + $signed(30'(depth1));
      level3 <= level2;
      head4 <= level3 + 30'(pressed3);

      cells1 <= (SUM - 11)'(sum[SUM-1:12]) + (SUM - 11)'(1);
      factor1 <= over == '0 ? 4'd1 : stiffness;
      by5 <= by4 > (SUM + 7)'(16383) ? 14'd16383 : by4[13:0];
      limit20 <= limit19 == 14'd0 ? 14'd1 : limit19;

      deep1 <= sum[SUM-1:4] == '0 ? DEPTH'(1) : sum[SUM-1:4];
      deep2 <= deep1;
      number2 <= {1'b0, yield_stress, 1'b0} + 26'(deep1[DEPTH-1:1]);
      dead <= dead27 == 25'd0 ? 25'd1 : dead27;

      big1 <= sum[SUM-1:18] != '0;
      capped1 <= sum[17:0];
      square5 <= big4 ? 29'h10000000 : {1'b0, square4[35:8]};
      low9 <= low8 + 47'h800000;
      high9 <= high8;
      raw10 <= high9 + 47'(low9[46:18]);

      // The shift to the right. What will be beyond the greatest mobility is cut before.
      warm17 <= {20'd0, low16} + {high16, 20'd0};
      warm18 <= warm17 >> {shift17[5:4], 4'd0};
      shift18 <= shift17[3:0];
      warm19 <= (warm18[52:37] != '0 ? '1 : warm18[36:0]) >> {shift18[3:2], 2'd0};
      shift19 <= shift18[1:0];
      warm20 <= (warm19[36:25] != '0 ? '1 : warm19[24:0]) >> shift19;
      mobility21 <= warm20[24:22] != '0 ? '1 : warm20[21:0];
    end
endmodule
