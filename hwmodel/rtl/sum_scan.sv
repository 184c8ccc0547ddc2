// The first scan of settle, of one lane (docs/automaton.md, section 10). It goes up, sums each run, and moves
// up what is too much below. Numbers tell how many registers a value is behind the cell that came. A run's
// record lies in the word of its uppermost cell: its sum, how many cells it has, and the heat of a mixture.
//
// No product and no division lies in a loop, but for heat that moves up. Whether a cell belongs to the run
// depends on `total`, the run's sum less ONE for each of its cells: one addition. Whether the run keeps its
// order is a bit, two registers later. Heat that moves up needs a division before the next cell can come, so
// it waits.
//
// A word is {set, mean heat, amount at the top, ordered, heat, cells less one, sum or amount, kind}. A solid's
// amount has its material above it.
module sum_scan #(
    parameter SUM = 28,  // bits of a run's sum
    parameter LAST = 12, // and of its number of cells, less one
    parameter MATERIALS = 0
) (
    input  logic                    clk,
    input  logic                    rst,
    input  logic                    move,
    input  voxmelt_pkg::cell_t      cell_in,
    input  logic                    bottom,    // no cell of its column came before it
    input  logic                    live4,     // a token, and no bits from before the reset, is in register 4
    input  logic                    hot,
    input  logic [15:0]             dither4,   // of the pass of the cell in register 4
    input  logic [15:0]             dither19,
    output logic                    works,     // no move is possible
    output logic [SUM+LAST+52:0]    word       // of the cell in register 24
);
  localparam [2:0] SOLID = 3'd0, INERT = 3'd1, OUTSIDE = 3'd2, INNER = 3'd3, FIRST = 3'd4, TOP = 3'd5, SINGLE = 3'd6;
  localparam signed [SUM:0] OVER = 61439;  // the most that a cell holds beyond ONE

  // Register 2: the loop of runs. `total` is that of the run with the cell in register 2, and `face` was the
  // excess at its lower face.
  voxmelt_pkg::cell_t cell1, cell2, cell3, cell4;
  logic [3:0] material5, material6, material22, material23;
  logic bottom1, half2;
  logic signed [16:0] above1;
  logic [2:0] kind1, kind2, kind3, kind4;
  logic signed [SUM:0] total2, face2, total3, total4;
  logic [LAST-1:0] last2, last3, last4;
  wire in_run2 = (kind2 == FIRST) | (kind2 == INNER);
  wire crowded = ~total2[SUM] & (total2 != '0);
  wire some1 = cell1.amount != 16'd0;
  assign kind1 = cell1.state == voxmelt_pkg::SOLID ? SOLID : cell1.state == voxmelt_pkg::INERT ? INERT
               : bottom1 | (kind2 == SOLID) | (kind2 == INERT) ? (some1 ? FIRST : OUTSIDE)
               : in_run2 & (crowded | (half2 & some1)) ? INNER : OUTSIDE;
  wire signed [SUM:0] joined = total2 + (SUM + 1)'(above1);

  // Registers 3 and 4: what moves up into a cell, and whether its run keeps its order.
  logic ok3, ordered4;
  logic [15:0] up3, up4, amount4;
  wire [16:0] held2 = {1'b0, cell2.amount} + {1'b0, face2[15:0]};
  wire inner3 = kind3 == INNER;
  wire ordered = kind3 == FIRST ? hot : inner3 ? ordered4 & ok3 : ordered4;
  wire [15:0] up = inner3 & ordered ? up3 : 16'd0;

  // Register 5: the loop of heat. `warmth` is the heat of the cell below.
  logic [15:0] warmth5, mixed;
  wire turns = hot & live4 & (up4 != 16'd0);
  serial_mixer rising (
      .clk(clk), .rst(rst), .start(turns), .move(move), .amount(cell4.amount), .heat(cell4.heat), .flow(up4),
      .flow_heat(warmth5), .dither(dither4), .works(works), .mixed(mixed));

  // The sum of amount x heat.
  logic signed [34:0] part4;
  logic [43:0] content5, content6;
  product of_heat (.clk(clk), .en(move), .a($signed({2'b0, cell1.amount})), .b({1'b0, cell1.heat}), .p(part4));

  // Register 6: the word. Registers 7 to 22: its mixture, by one division.
  logic [2:0] kind5, kind6;
  logic [15:0] amount5, left5, heat6;
  logic ends5, ordered5, set5, record6, ordered6, set6;
  logic signed [SUM:0] total5;
  logic [LAST-1:0] last5, last6;
  logic [SUM-1:0] sum6;
  logic [15:0] top6;
  wire keeps5 = ordered5 & (total5[SUM] | (total5 == '0));
  logic [16*SUM-1:0] divisors;
  logic [15:0] mean22;
  logic signed [SUM:0] rest22;
  divider #(.REST(SUM), .QUOTIENT(16), .NUMBER(44)) mixture (
      .clk(clk), .en(move), .number(content6), .by(sum6), .divisors(divisors), .quotient(mean22), .rest(rest22));
  logic [SUM+15:0] rounding22;
  long_product #(.A(SUM), .B(16)) times_dither (
      .clk(clk), .en(move), .a(divisors[12*SUM+:SUM]), .b(dither19), .p(rounding22));
  if (MATERIALS != 0) begin : many
    always_ff @(posedge clk)
      if (move) begin
        material5 <= cell4.state == voxmelt_pkg::SOLID ? cell4.energy[3:0] : 4'd0;
        material6 <= material5;
        material23 <= material22;
      end
    delay #(.WIDTH(4), .N(16)) numbers (.clk(clk), .en(move), .d(material6), .q(material22));
  end else begin : one
    assign {material5, material6, material22, material23} = 16'd0;
  end
  logic [LAST+37:0] rest_of_word22, rest_of_word23;
  delay #(.WIDTH(LAST + 38), .N(16)) waits (
      .clk(clk), .en(move), .d({record6, set6, top6, ordered6, heat6, last6, kind6}), .q(rest_of_word22));
  logic signed [SUM+1:0] over23;
  logic [SUM-1:0] sum23, bound23;  // a rest below 0 lacks the sum
  logic [15:0] mean23, more23;
  wire [2:0] kind23 = rest_of_word23[2:0];
  wire [LAST-1:0] last23 = rest_of_word23[3+:LAST];
  wire [15:0] heat23 = rest_of_word23[LAST+3+:16], top23 = rest_of_word23[LAST+20+:16];
  wire ordered23 = rest_of_word23[LAST+19], set23 = rest_of_word23[LAST+36], record23 = rest_of_word23[LAST+37];
  wire [15:0] rounded23 = over23 >= $signed({2'b0, bound23}) ? more23 : mean23;

  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      bottom1 <= bottom;
      above1 <= $signed({1'b0, cell_in.amount}) - $signed({1'b0, voxmelt_pkg::ONE});

      cell2 <= cell1;
      kind2 <= kind1;
      half2 <= cell1.amount >= 16'd2048;
      face2 <= total2;
      total2 <= kind1 == INNER ? joined : (SUM + 1)'(above1);
      last2 <= kind1 == INNER ? last2 + LAST'(1) : '0;

      cell3 <= cell2;
      kind3 <= kind2;
      total3 <= total2;
      last3 <= last2;
      ok3 <= face2[SUM] ? face2 >= -OVER : (face2[SUM-1:16] == '0) & ~held2[16];
      up3 <= face2[SUM] ? 16'd0 : face2[15:0];

      cell4 <= cell3;
      kind4 <= kind3;
      total4 <= total3;
      last4 <= last3;
      ordered4 <= ordered;
      up4 <= up;
      amount4 <= cell3.amount + up;

      kind5 <= kind4;
      total5 <= total4;
      last5 <= last4;
      ordered5 <= ordered4;
      set5 <= cell4.is_set;
      amount5 <= amount4;
      left5 <= amount4 - up;
      ends5 <= ((kind4 == FIRST) | (kind4 == INNER)) & ~inner3;
      warmth5 <= turns ? mixed : cell4.heat;
      content5 <= 44'(part4[31:0]) + (kind4 == INNER ? content5 : 44'd0);

      kind6 <= ~ends5 ? kind5 : kind5 == FIRST ? SINGLE : TOP;
      record6 <= hot & ends5 & ~keeps5;
      sum6 <= ends5 ? total5[SUM-1:0] + {(SUM - 12)'(last5) + (SUM - 12)'(1), 12'd0} : SUM'(left5);
      last6 <= ends5 ? last5 : '0;
      heat6 <= warmth5;
      ordered6 <= ends5 & keeps5;
      top6 <= ends5 & keeps5 ? amount5 : 16'd0;
      set6 <= set5;
      content6 <= content5;

      over23 <= (SUM + 2)'(rest22) + $signed({1'b0, rounding22[SUM+15:16]});
      sum23 <= divisors[15*SUM+:SUM];
      bound23 <= rest22[SUM] ? '0 : divisors[15*SUM+:SUM];
      mean23 <= mean22;
      more23 <= mean22 + 16'd1;
      rest_of_word23 <= rest_of_word22;

      word <= {set23, (kind23 == TOP) | (kind23 == SINGLE) ? mean23 : 16'd0, top23, ordered23,
               record23 ? rounded23 : heat23, {last23, sum23} | (SUM + LAST)'({material23, 16'd0}), kind23};
    end
endmodule
