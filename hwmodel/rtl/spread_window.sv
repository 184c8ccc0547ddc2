// What lies beside and across the four pairs that a cell q completes, and which of them there are
// (docs/automaton.md, section 11). Edges are what a cell keeps of its west and its south: {rise from the
// south, rise from the west, south blocked, west blocked}.
module spread_window (
    input  logic        clk,
    input  logic        move,
    input  logic [19:0] q1,            // {blocked, has a bed, its height} at position 1
    input  logic [19:0] w1,
    input  logic [19:0] s1,
    input  logic [19:0] sw1,
    input  logic        has_west1,
    input  logic        has_south1,    // of the same pass
    input  logic        ends_row1,     // w and sw are the ends of a row, and both of one pass
    input  logic        ends_pass1,    // s and sw are of one pass
    input  logic [13:0] w_edges2,
    input  logic [13:0] s_edges2,
    input  logic [13:0] sw_edges2,
    output logic [13:0] q_edges2,
    output logic [3:0]  valid2,        // {s with sw, w with sw, w with s, q with sw}
    output logic [2:0]  beside_x3,     // of s with sw
    output logic [2:0]  beside_z3,     // of w with sw
    output logic [19:0] across5        // 5 bits of each pair, in the order of valid2
);
  // How far the bed rises from one cell to another one. It is 0 where one of them shows none.
  function automatic signed [5:0] rise(input [19:0] from, input [19:0] to);
    reg signed [18:0] apart;
    begin
      apart = $signed({to[17], to[17:0]}) - $signed({from[17], from[17:0]});
      rise = ~(from[18] & to[18]) ? 6'sd0 : apart > 19'sd31 ? 6'sd31 : apart < -19'sd31 ? -6'sd31 : apart[5:0];
    end
  endfunction
  function automatic signed [5:0] greater(input signed [5:0] a, input signed [5:0] b);
    greater = a > b ? a : b;
  endfunction
  function automatic signed [5:0] less(input signed [5:0] a, input signed [5:0] b);
    less = a < b ? a : b;
  endfunction
  function automatic [4:0] size(input signed [5:0] a);
    size = a[5] ? -a[4:0] : a[4:0];
  endfunction
  function automatic [4:0] apart_of(input signed [5:0] high, input signed [5:0] low);
    reg [4:0] up, down;
    begin
      up = high[5] ? 5'd0 : high[4:0];
      down = low[5] ? -low[4:0] : 5'd0;
      apart_of = up > down ? up - down : down - up;
    end
  endfunction

  logic signed [5:0] corner_up2, corner_down2;
  logic [4:0] up3, up4, down3, down4;
  logic [3:0] blocked2;  // {q, w, s, sw}
  logic west2, south2;
  logic signed [5:0] high_w3, low_w3, high_q3, low_q3, high_z4, low_z4;  // of w with sw
  logic signed [5:0] high_s3, low_s3, high_o3, low_o3, high_x4, low_x4;  // of s with sw
  wire signed [5:0] q_west2 = q_edges2[7:2], q_south2 = q_edges2[13:8], w_west2 = w_edges2[7:2], w_south2 = w_edges2[13:8];
  wire signed [5:0] s_west2 = s_edges2[7:2], s_south2 = s_edges2[13:8], sw_west2 = sw_edges2[7:2], sw_south2 = sw_edges2[13:8];

  // Beyond the end of a row, and of a plane, all is blocked.
  wire q_east2 = ~west2 | blocked2[3], s_east2 = ~west2 | blocked2[1];
  wire q_north2 = ~south2 | blocked2[3], w_north2 = ~south2 | blocked2[2];

  always_ff @(posedge clk)
    if (move) begin
      q_edges2 <= {has_south1 ? rise(s1, q1) : 6'sd0, has_west1 ? rise(w1, q1) : 6'sd0, ~has_south1 | s1[19],
                   ~has_west1 | w1[19]};
      corner_up2 <= rise(w1, s1);
      corner_down2 <= rise(q1, sw1);
      blocked2 <= {q1[19], w1[19], s1[19], sw1[19]};
      west2 <= has_west1;
      south2 <= has_south1;
      valid2 <= {has_west1 & ends_pass1, has_west1 ? has_south1 : ends_row1,
                 has_west1 & has_south1 & ~(q1[19] & sw1[19]), has_west1 & has_south1 & ~(w1[19] & s1[19])};

      beside_z3 <= (3'(q_east2) + 3'(s_east2)) + (3'(w_edges2[0]) + 3'(sw_edges2[0]));
      beside_x3 <= (3'(q_north2) + 3'(w_north2)) + (3'(s_edges2[1]) + 3'(sw_edges2[1]));
      up3 <= size(corner_up2);
      down3 <= size(corner_down2);
      high_w3 <= greater(w_west2, sw_west2);
      low_w3 <= less(w_west2, sw_west2);
      high_q3 <= greater(q_west2, s_west2);
      low_q3 <= less(q_west2, s_west2);
      high_s3 <= greater(s_south2, sw_south2);
      low_s3 <= less(s_south2, sw_south2);
      high_o3 <= greater(q_south2, w_south2);
      low_o3 <= less(q_south2, w_south2);

      up4 <= up3;
      down4 <= down3;
      high_z4 <= greater(high_w3, high_q3);
      low_z4 <= less(low_w3, low_q3);
      high_x4 <= greater(high_s3, high_o3);
      low_x4 <= less(low_s3, low_o3);

      across5 <= {apart_of(high_x4, low_x4), apart_of(high_z4, low_z4), down4, up4};
    end
endmodule
