// Gravity of one lane, under both laws, and the paper's excess (docs/automaton.md, section 8), under both
// readings of the energy. Numbers tell how many registers a value is behind the cell q that came, which meets the cell p below
// it. The cell p is complete then, and leaves.
//
// No product lies in a loop, but for heat that climbs. What falls depends on amounts alone:
//
//   a_q' = max(a_q - ready, a_q - ONE + a_p)   falling,   min(a_q - ONE + a_p, AMAX)   climbing
//
// `ready` depends on q as it came. Energy follows seven registers later and knows the flow. Heat that falls is
// mixed outside of all loops. Heat that climbs needs a division before the next cell can come, so it waits.
//
// Under the viscous law nothing climbs, and no cell of a run falls.
module gravity_lane (
    input  logic               clk,
    input  logic               rst,
    input  logic               move,
    input  voxmelt_pkg::cell_t cell_in,
    input  logic               in_run,       // the same cell
    input  logic               first,        // no cell of its column came before it
    input  logic               top,          // nothing comes above it
    input  logic               live13,       // a token, and no bits from before the reset, is in register 13
    input  logic [15:0]        dither13,     // of the step of the cell in register 13
    input  logic [15:0]        dither18,
    input  logic               paper,        // the law
    input  logic               hot,
    input  logic               printed,      // the reading of the energy's equations
    input  logic [16:0]        factor,
    input  logic [16:0]        wall_factor,
    input  logic [15:0]        minimum,
    input  logic [15:0]        hang,
    input  logic [18:0]        beta,
    output logic               works,        // no move is possible
    output voxmelt_pkg::cell_t cell_out      // p, 39 registers behind q
);
  // Registers 1 to 6 prepare what q is ready to give.
  voxmelt_pkg::cell_t cell1, cell2, cell5, cell6;
  logic first1, top1, free1, stays2, hangs2, free2, first5, stays5, hangs5, free5, first6, hangs6, holds6;
  logic [16:0] want5;
  logic [16:0] left6;
  logic signed [17:0] above6;
  logic signed [34:0] part4;
  wire covered1 = cell1.beside_wall | top1 | cell_in.state[1];
  product times_factor (
      .clk(clk), .en(move), .a($signed({2'b0, cell1.amount})), .b(cell1.beside_wall ? wall_factor : factor),
      .p(part4));
  delay #(.WIDTH(71), .N(3)) prepares (
      .clk(clk), .en(move), .d({free2, first2, stays2, hangs2, cell2}),
      .q({free5, first5, stays5, hangs5, cell5}));
  logic first2;
  wire [15:0] ready5 = stays5 ? 16'd0 : want5 > 17'(cell5.amount) ? cell5.amount : want5[15:0];

  // Register 7: the loop of amounts. `low` is the present amount of p.
  voxmelt_pkg::cell_t cell7, cell8;
  logic [15:0] low, low7, high7;
  logic low_blocked, down7, up7;
  wire signed [17:0] sum = above6 + $signed({2'b0, low});  // a_q - ONE + a_p
  wire pair = ~first6 & ~low_blocked & ~cell6.state[1];
  // ONE is a power of two, so these are no comparisons with a carry.
  wire low_full = low[15:12] != 4'd0, low_part = low[11:0] != 12'd0;
  wire down = pair & holds6 & ~low_full & ~(hangs6 & ~low_part);
  wire up = paper & pair & (low[15:13] != 3'd0 | (low[12] & low_part));
  wire [15:0] fallen = sum > $signed({1'b0, left6}) ? sum[15:0] : left6[15:0];
  wire [15:0] risen = sum > $signed({2'b0, voxmelt_pkg::AMAX}) ? voxmelt_pkg::AMAX : sum[15:0];
  wire [15:0] high = down ? fallen : up ? risen : cell6.amount;

  // Registers 8 to 13: the flow, the energy that goes with it, and what arrives of that.
  logic [15:0] flow8, low8, high8, moved9, stays9, flow9, low9, after9, high9;
  logic down8, up8, down9, up9;
  voxmelt_pkg::cell_t cell9, cell12, cell13;
  logic down12, up12, down13, up13;
  logic [15:0] stays12, flow12, low12, after12, high12, stays13, flow13, low13, after13, high13, gain13;
  logic [15:0] left13, highest13;
  logic signed [17:0] base13, bound13;
  logic paid13, fixed13;
  logic signed [36:0] gain12;
  product #(.B(19)) times_beta (.clk(clk), .en(move), .a($signed({2'b0, moved9})), .b(beta), .p(gain12));
  delay #(.WIDTH(67 + 82), .N(3)) waits_for_beta (
      .clk(clk), .en(move), .d({down9, up9, stays9, flow9, low9, after9, high9, cell9}),
      .q({down12, up12, stays12, flow12, low12, after12, high12, cell12}));
  wire [18:0] whole_gain12 = gain12[34:16];
  wire [15:0] most12 = printed ? cell12.energy : voxmelt_pkg::AMAX;
  wire paid12 = printed & down12;  // what p gains, q has paid
  wire signed [17:0] energy12 = $signed({2'b0, cell12.energy});
  wire signed [20:0] kept12 = $signed({2'b0, whole_gain12});
  wire signed [20:0] left12 = 21'(energy12) - kept12;

  // Register 14: the loops of energy and heat. `held` is the present energy of p, `warmth` its present heat.
  logic [15:0] held, warmth, mixed;
  logic [1:0] below;
  logic below_set;
  // With the present energy of p, that of q grows by as much, between two values. They and the bounds of
  // `held` at which it reaches them are known before, but for the bound of a gain that p has room for.
  wire signed [17:0] here = $signed({2'b0, held});
  wire signed [17:0] shifted = base13 + here;
  wire beyond = here > bound13;
  wire [17:0] ones = here ^ {2'b0, gain13} ^ ~{2'b0, after13};
  wire [17:0] twos = here & {2'b0, gain13} | (here | {2'b0, gain13}) & ~{2'b0, after13};
  wire [17:0] over = ones + {twos[16:0], 1'b0};  // held + gain - after - 1
  wire fits = over[17];
  wire [15:0] lowest = left13 < high13 ? left13 : high13;
  wire [15:0] held_next = fixed13 ? stays13 : paid13 & fits ? lowest : beyond ? highest13 : shifted[15:0];
  wire [15:0] with_gain = held + gain13, without_flow = held - flow13;
  wire turns = hot & live13 & up13 & (flow13 != 16'd0);
  serial_mixer climbing (
      .clk(clk), .rst(rst), .start(turns), .move(move), .amount(cell13.amount), .heat(cell13.heat), .flow(flow13),
      .flow_heat(warmth), .dither(dither13), .works(works), .mixed(mixed));

  // From register 15 on: the heat of p and of what fell.
  logic [15:0] energy14, amount14, warmth14, low14, flow14, heat14;
  logic [1:0] state14;
  logic set14, mixes14;
  logic signed [34:0] here17, fallen17;
  logic [31:0] content18;
  logic [15:0] amount18, heat38, energy38, amount38, warmth38;
  logic [1:0] state38;
  logic set38, mixes38;
  product content_here (
      .clk(clk), .en(move), .a($signed({2'b0, low14})), .b({1'b0, warmth14}), .p(here17));
  product content_fallen (
      .clk(clk), .en(move), .a($signed({2'b0, flow14})), .b({1'b0, heat14}), .p(fallen17));
  delay #(.WIDTH(16), .N(4)) amounts (.clk(clk), .en(move), .d(amount14), .q(amount18));
  mixer falling (
      .clk(clk), .en(move), .content(content18), .amount(amount18), .dither(dither18), .heat(heat38));
  delay #(.WIDTH(52), .N(24)) waits_for_heat (
      .clk(clk), .en(move), .d({mixes14, set14, state14, warmth14, energy14, amount14}),
      .q({mixes38, set38, state38, warmth38, energy38, amount38}));
  wire blocked38 = state38[1];
  wire empty38 = ~blocked38 & (amount38 == 16'd0);

  always_ff @(posedge clk)
    if (move) begin
      cell1 <= cell_in;
      first1 <= first;
      top1 <= top;
      free1 <= paper | ~in_run;
      cell2 <= cell1;
      first2 <= first1;
      free2 <= free1;
      stays2 <= cell1.is_set & covered1;
      hangs2 <= (cell1.amount < hang) & covered1;

      want5 <= 17'(part4[31:16]) + {1'b0, minimum};
      cell6 <= cell5;
      first6 <= first5;
      hangs6 <= hangs5;
      holds6 <= free5 & (cell5.amount != 16'd0);
      left6 <= 17'(cell5.amount) - 17'(ready5);
      above6 <= $signed({2'b0, cell5.amount}) - $signed({2'b0, voxmelt_pkg::ONE});

      cell7 <= cell6;
      down7 <= down;
      up7 <= up;
      high7 <= high;
      low7 <= low;
      low <= high;
      low_blocked <= cell6.state[1];

      cell8 <= cell7;
      down8 <= down7;
      up8 <= up7;
      low8 <= low7;
      high8 <= high7;
      flow8 <= down7 ? cell7.amount - high7 : up7 ? high7 - cell7.amount : 16'd0;

      cell9 <= cell8;
      down9 <= down8;
      up9 <= up8;
      flow9 <= flow8;
      low9 <= low8;
      high9 <= high8;
      after9 <= up8 ? low8 - flow8 : low8 + flow8;
      moved9 <= ~down8 ? 16'd0 : cell8.energy < flow8 ? cell8.energy : flow8;
      stays9 <= ~down8 ? cell8.energy : cell8.energy < flow8 ? 16'd0 : cell8.energy - flow8;

      cell13 <= cell12;
      down13 <= down12;
      up13 <= up12;
      stays13 <= stays12;
      flow13 <= flow12;
      low13 <= low12;
      high13 <= high12;
      after13 <= after12;
      gain13 <= whole_gain12 > 19'(most12) ? most12 : whole_gain12[15:0];
      paid13 <= paid12;
      fixed13 <= ~paid12 & ~up12;
      left13 <= left12[20] ? 16'd0 : left12[15:0];
      base13 <= paid12 ? energy12 - $signed({2'b0, after12}) : $signed({2'b0, stays12});
      bound13 <= paid12 ? 18'sd131071 : $signed({2'b0, flow12});  // who has paid is never beyond
      highest13 <= stays12 + flow12;

      energy14 <= down13 ? (fits ? with_gain : after13) : ~up13 ? held : beyond ? without_flow : 16'd0;
      amount14 <= after13;
      state14 <= below;
      set14 <= below_set;
      warmth14 <= warmth;
      low14 <= low13;
      flow14 <= flow13;
      heat14 <= cell13.heat;
      mixes14 <= down13 & (flow13 != 16'd0);
      held <= held_next;
      warmth <= turns ? mixed : cell13.heat;
      below <= cell13.state;
      below_set <= paper & cell13.is_set;  // the viscous law has spread before

      content18 <= here17[31:0] + fallen17[31:0];

      cell_out <= '0;
      cell_out.amount <= amount38;
      cell_out.energy <= empty38 ? 16'd0 : energy38;
      cell_out.heat <= empty38 | ~hot ? 16'd0 : mixes38 ? heat38 : warmth38;
      cell_out.state <= blocked38 ? state38 : empty38 ? voxmelt_pkg::AIR : voxmelt_pkg::LIQUID;
      cell_out.is_set <= set38;
    end
endmodule
