// What flows between two cells that are open to each other (docs/automaton.md, section 11, one stage). The
// cell with the higher head gives, if it is in a run. Numbers are positions: a cell is seen at position 2.
//
// Nothing returns, so products have registers.
module pair_unit #(
    parameter DIAGONAL = 0
) (
    input  logic         clk,
    input  logic         move,
    input  logic         valid2,
    input  logic [167:0] a2,           // run_reader.sv has their parts
    input  logic [167:0] b2,
    input  logic [2:0]   beside3,      // blocked cells beside the pair
    input  logic [4:0]   across5,      // how far the bed rises across it
    input  logic [15:0]  rounding16,
    output logic [15:0]  amount22,     // what a gets; b gets the opposite
    output logic [31:0]  content22     // amount x heat
);
  localparam [9:0] MOST = DIAGONAL != 0 ? 10'd724 : 10'd512;
  wire a_blocked = a2[167], b_blocked = b2[167];

  // Positions 3 and 4: who gives?
  logic signed [30:0] apart3;
  logic signed [18:0] beds3;
  logic has_beds3, active3, active4;
  logic [167:0] a3, b3;
  wire a_gives3 = ~apart3[30];
  wire [167:0] from3 = a_gives3 ? a3 : b3, to3 = a_gives3 ? b3 : a3;
  wire [18:0] steep3 = beds3[18] ? -beds3 : beds3;
  logic a_gives4, level4;
  logic [29:0] drop4;
  logic [4:0] along4;
  logic from_runs4, from_set4, both_shut4, to_runs4, to_limits4;
  logic [24:0] dead4;
  logic [13:0] limit4;
  logic [21:0] to_run4, to_flank4, takes4;
  logic [15:0] held4, other4, heat4;

  // Positions 5 to 7: mobility, amounts, slope.
  logic rests5, rests6, limits5, limits6;
  logic [28:0] zone5;
  logic [29:0] drop5;
  logic [9:0] capped5, capped10;
  logic [21:0] gives5, takes5;
  logic [13:0] limit5, limit6;
  logic [22:0] mobility6, mobility7;
  logic [15:0] mean5, mean7, room5, held5, least6;
  logic [9:0] along5, along6, across6;
  logic [10:0] square7;
  logic [8:0] index8;
  wire [16:0] both4 = {1'b0, held4} + {1'b0, other4} + 17'd1;
  wire [28:0] eleven4 = {1'b0, dead4, 3'd0} + {3'd0, dead4, 1'b0} + {4'd0, dead4};
  wire [22:0] cap6 = {limit6, 9'd0};

  // The factor of the slope, by the square of the plane's slope.
  logic [14:0] factors[0:511];
  function automatic [14:0] factor_of(input integer square);
    integer root;
    root = 4194304 / (256 + square);
    factor_of = 15'((root * root) >> 14);
  endfunction
  initial for (int i = 0; i < 512; i++) factors[i] = factor_of(i);
  logic [14:0] plane9, slope10;
  logic [2:0] beside9;
  wire [14:0] eighth9 = {3'd0, plane9[14:3]};

  // The flow.
  logic [38:0] conducted10;
  logic [23:0] conductance11, conductance13;
  logic signed [34:0] driven13, part9;
  logic [37:0] flow16;
  logic [38:0] rounded16;
  logic [12:0] flow17;
  logic [13:0] most9, most17, amount18, amount21;
  logic rests17, gives21;
  logic [15:0] heat18;
  logic signed [34:0] content21;
  long_product #(.A(23), .B(16)) conducts (.clk(clk), .en(move), .a(mobility7), .b(mean7), .p(conducted10));
  product drives (.clk(clk), .en(move), .a($signed({3'd0, slope10})), .b({7'd0, capped10}), .p(driven13));
  long_product #(.A(24), .B(14)) flows (
      .clk(clk), .en(move), .a(conductance13), .b(driven13[23:10]), .p(flow16));
  product fifth (.clk(clk), .en(move), .a(18'sd13107), .b({1'b0, least6}), .p(part9));
  product carries (.clk(clk), .en(move), .a($signed({4'd0, amount18})), .b({1'b0, heat18}), .p(content21));
  delay #(.WIDTH(10), .N(5)) drops (.clk(clk), .en(move), .d(capped5), .q(capped10));
  delay #(.WIDTH(16), .N(2)) means (.clk(clk), .en(move), .d(mean5), .q(mean7));
  delay #(.WIDTH(3), .N(6)) besides (.clk(clk), .en(move), .d(beside3), .q(beside9));
  delay #(.WIDTH(24), .N(2)) conductances (.clk(clk), .en(move), .d(conductance11), .q(conductance13));
  delay #(.WIDTH(14), .N(8)) mosts (.clk(clk), .en(move), .d(most9), .q(most17));
  delay #(.WIDTH(1), .N(11)) restings (.clk(clk), .en(move), .d(rests6), .q(rests17));
  delay #(.WIDTH(16), .N(14)) heats (.clk(clk), .en(move), .d(heat4), .q(heat18));
  delay #(.WIDTH(1), .N(17)) givers (.clk(clk), .en(move), .d(a_gives4), .q(gives21));
  delay #(.WIDTH(14), .N(3)) amounts (.clk(clk), .en(move), .d(amount18), .q(amount21));
  assign most9 = DIAGONAL != 0 ? {2'd0, part9[29:18]} : part9[29:16];
  assign rounded16 = {1'b0, flow16} + (DIAGONAL != 0 ? {11'd0, rounding16, 12'd0} : {13'd0, rounding16, 10'd0});

  always_ff @(posedge clk)
    if (move) begin
      apart3 <= $signed({a2[61], a2[61:32]}) - $signed({b2[61], b2[61:32]});
      beds3 <= $signed({a2[79], a2[79:62]}) - $signed({b2[79], b2[79:62]});
      has_beds3 <= a2[164] & b2[164];
      active3 <= valid2 & ~a_blocked & ~b_blocked;
      a3 <= a2;
      b3 <= b2;

      active4 <= active3;
      a_gives4 <= a_gives3;
      drop4 <= a_gives3 ? apart3[29:0] : -apart3[29:0];
      along4 <= ~has_beds3 ? 5'd0 : steep3 > 19'd31 ? 5'd31 : steep3[4:0];
      level4 <= has_beds3 & (beds3 == 19'sd0);
      from_runs4 <= from3[166];
      from_set4 <= from3[165];
      both_shut4 <= from3[163] & to3[163];
      dead4 <= from3[162:138];
      limit4 <= from3[137:124];
      to_flank4 <= from3[123:102];
      to_run4 <= from3[101:80];
      held4 <= from3[15:0];
      heat4 <= from3[31:16];
      to_runs4 <= to3[166];
      to_limits4 <= to3[137:124] != 14'd0;
      takes4 <= to3[101:80];
      other4 <= to3[15:0];

      rests5 <= ~active4 | ~from_runs4 | from_set4 | both_shut4;
      zone5 <= DIAGONAL != 0 ? 29'(eleven4[28:3]) : {4'd0, dead4};  // 11 / 8 of it
      drop5 <= drop4;
      capped5 <= drop4 > {20'd0, MOST} ? MOST : drop4[9:0];
      gives5 <= to_runs4 ? to_run4 : to_flank4;
      takes5 <= takes4;
      limits5 <= to_limits4;
      limit5 <= limit4;
      mean5 <= level4 ? both4[16:1] : held4;
      room5 <= to_runs4 ? voxmelt_pkg::AMAX - other4 : other4 < voxmelt_pkg::ONE ? voxmelt_pkg::ONE - other4 : 16'd0;
      held5 <= held4;
      along5 <= {5'd0, along4} * {5'd0, along4};

      rests6 <= rests5 | (drop5 <= {1'b0, zone5});
      mobility6 <= {1'b0, gives5} + {1'b0, takes5};
      limits6 <= limits5;
      limit6 <= limit5;
      least6 <= held5 < room5 ? held5 : room5;
      along6 <= along5;
      across6 <= {5'd0, across5} * {5'd0, across5};

      mobility7 <= limits6 & (mobility6 > cap6) ? cap6 : mobility6;
      square7 <= ({1'b0, along6} + {1'b0, across6}) >> (DIAGONAL != 0 ? 1 : 0);
      index8 <= square7 > 11'd511 ? 9'd511 : square7[8:0];
      plane9 <= factors[index8];
      slope10 <= (plane9 + (beside9[0] ? eighth9 : 15'd0))
               + ((beside9[1] ? eighth9 << 1 : 15'd0) + (beside9[2] ? eighth9 << 2 : 15'd0));

      conductance11 <= conducted10[38:36] != 3'd0 ? 24'hFFFFFF : conducted10[35:12];
      flow17 <= DIAGONAL != 0 ? {2'd0, rounded16[38:28]} : rounded16[38:26];
      amount18 <= rests17 ? 14'd0 : {1'b0, flow17} < most17 ? {1'b0, flow17} : most17;

      amount22 <= gives21 ? 16'd0 - 16'(amount21) : 16'(amount21);
      content22 <= gives21 ? 32'd0 - content21[31:0] : content21[31:0];
    end
endmodule
