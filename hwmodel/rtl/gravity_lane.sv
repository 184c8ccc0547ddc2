// Gravity and excess of one lane: paper law, reading `text`, without heat (docs/automaton.md, section 8).
//
// A column comes from below. A slot holds its cell q, and gives the cell p below it, which is complete then.
// What falls depends on amounts alone. So their loop runs three registers ahead of that of energy, and no
// product lies in a loop:
//
//   a_q' = max(a_q - ready, a_q - ONE + a_p)   falling,   min(a_q - ONE + a_p, AMAX)   climbing
//
// `ready` depends on q as it came. The product with beta only reaches p, which leaves.
module gravity_lane (
    input  logic                  clk,
    input  logic                  en,     // all slots move on
    input  logic                  v3,     // the slot in register 3 is no bubble
    input  logic                  f3,     // it has no cell below it
    input  logic                  v6,     // the slot in register 6 is no bubble
    input  voxmelt_pkg::falling_t q,
    input  logic [16:0]           factor,
    input  logic [16:0]           wall_factor,
    input  logic [15:0]           minimum,
    input  logic [18:0]           beta,
    output voxmelt_pkg::cell_t    p       // 10 registers behind q
);
  // Registers 1 to 3 prepare what q is ready to give.
  voxmelt_pkg::cell_t q1, q2, q3;
  logic [32:0] product1;
  logic [15:0] ready2;
  logic        holds3;
  logic [16:0] left3;
  logic signed [17:0] above3;
  wire [16:0] factor0 = q.beside_wall ? wall_factor : factor;
  wire [15:0] part1 = 16'(product1 >> 16);  // less than 2^16, as a factor is at most 1
  wire [16:0] want1 = 17'(part1) + 17'(minimum);

  // Register 4: the loop of amounts. `low` is the present amount of p.
  voxmelt_pkg::cell_t q4;
  logic [15:0] low, low4, high4;
  logic        low_blocked, down4, up4;
  wire signed [17:0] sum = above3 + $signed({2'b0, low});  // a_q - ONE + a_p
  wire pair = ~f3 & ~low_blocked & ~q3.state[1];
  wire down = pair & holds3 & (low < voxmelt_pkg::ONE);
  wire up = pair & ~down & (low > voxmelt_pkg::ONE);
  wire [15:0] fallen = sum > $signed({1'b0, left3}) ? sum[15:0] : left3[15:0];
  wire [15:0] risen = sum > $signed({2'b0, voxmelt_pkg::AMAX}) ? voxmelt_pkg::AMAX : sum[15:0];
  wire [15:0] high = down ? fallen : up ? risen : q3.amount;

  // Registers 5 and 6: the flow, and the energy that moves and stays.
  logic [15:0] energy5, flow5, low5, flow6, low6, moved6, stays6;
  logic [1:0]  state5, state6;
  logic        down5, up5, up6;
  wire [15:0] flow = down4 ? q4.amount - high4 : up4 ? high4 - q4.amount : 16'd0;
  wire [15:0] rest = energy5 > flow5 ? energy5 - flow5 : 16'd0;

  // Register 7: the loop of energy. `held` is the present energy of p.
  logic [15:0] held, held7, low7, moved7;
  logic [1:0]  below, state7;
  wire [15:0] climbs = ~up6 ? 16'd0 : held < flow6 ? held : flow6;

  // Registers 8 to 10: what p gains.
  logic [34:0] product8;
  logic [15:0] held8, low8, room8, held9, low9, room9;
  logic [1:0]  state8, state9;
  logic [18:0] gain9;
  wire blocked9 = state9[1];
  wire empty9 = ~blocked9 & (low9 == 16'd0);
  wire [15:0] gained9 = gain9 < 19'(room9) ? gain9[15:0] : room9;

  always_ff @(posedge clk)
    if (en) begin
      q1 <= {q.energy, q.amount, q.state};
      product1 <= 33'(q.amount) * 33'(factor0);

      q2 <= q1;
      ready2 <= want1 > 17'(q1.amount) ? q1.amount : want1[15:0];

      q3 <= q2;
      holds3 <= q2.amount != 16'd0;
      left3 <= 17'(q2.amount) - 17'(ready2);
      above3 <= $signed({2'b0, q2.amount}) - $signed({2'b0, voxmelt_pkg::ONE});

      q4 <= q3;
      down4 <= down;
      up4 <= up;
      high4 <= high;
      low4 <= low;
      if (v3) begin
        low <= high;
        low_blocked <= q3.state[1];
      end

      energy5 <= q4.energy;
      state5 <= q4.state;
      down5 <= down4;
      up5 <= up4;
      flow5 <= flow;
      low5 <= down4 ? low4 + flow : low4 - flow;

      state6 <= state5;
      up6 <= up5;
      flow6 <= flow5;
      low6 <= low5;
      moved6 <= ~down5 ? 16'd0 : energy5 < flow5 ? energy5 : flow5;
      stays6 <= ~down5 ? energy5 : rest;

      held7 <= held - climbs;
      low7 <= low6;
      moved7 <= moved6;
      state7 <= below;
      if (v6) begin
        held <= stays6 + climbs;
        below <= state6;
      end

      product8 <= 35'(moved7) * 35'(beta);
      held8 <= held7;
      low8 <= low7;
      room8 <= low7 - held7;
      state8 <= state7;

      gain9 <= 19'(product8 >> 16);
      held9 <= held8;
      low9 <= low8;
      room9 <= room8;
      state9 <= state8;

      p.amount <= low9;
      p.energy <= held9 + gained9;  // 0 if the cell is empty, as no energy exceeds its amount
      p.state <= blocked9 ? state9 : empty9 ? voxmelt_pkg::AIR : voxmelt_pkg::LIQUID;
    end
endmodule
