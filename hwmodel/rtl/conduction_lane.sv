// Conduction through faces, of one lane (docs/automaton.md, section 6). A pair is computed once, when the
// later of its two cells comes. Both get their flow six registers later, wherever they are in the line then:
// so the cell west, below and south of it wait in six registers, too.
//
// A word of the line is {touches, beside_wall, exposed, temperature, heat, energy, amount, state}.
module conduction_lane #(
    parameter MATERIALS = 0
) (
    input  logic        clk,
    input  logic        move,
    input  logic [70:0] word_in,
    input  logic        west_there,    // these are known with the word in register 1
    input  logic        below_there,
    input  logic        south_there,
    input  logic        at_side,       // a side of this cell is the border
    input  logic        at_end,        // its floor or its ceiling is the border
    input  logic [70:0] west,          // word of the western cell, with this one in register 1
    input  logic [70:0] south,
    input  logic [70:0] east,          // of the eastern cell in this token
    input  logic        east_there,
    input  logic [15:0] east_flow6,
    input  logic [(16<<(2*MATERIALS))-1:0] weights,
    input  logic [15:0] dither_x,      // of the step of the word in register 5
    input  logic [15:0] dither_y,
    input  logic [15:0] dither_z,
    output logic [70:0] word1,
    output logic [70:0] word9,         // on its way to the east
    output logic [15:0] west_flow6,   // none where there is no such cell
    output logic [15:0] south_flow6
);
  logic [70:0] word2, word6, word7, word8;
  logic signed [17:0] drop_x2, drop_y2, drop_z2;
  logic [15:0] flow_x6, flow_y6, flow_z6, flow_y7, both7;
  logic signed [34:0] product_x5, product_y5, product_z5;

  // Flow goes from q, which comes, to p. Neither air nor a cold inert cell conducts.
  function automatic conducts(input [70:0] word);
    conducts = (word[1] ^ word[0]) | (word[1] & word[0] & (word[49:34] != 16'd0));
  endfunction
  function automatic signed [17:0] drop(input there, input [70:0] p, input [70:0] q);
    drop = there & conducts(p) & conducts(q) ? $signed({2'b0, q[65:50]}) - $signed({2'b0, p[65:50]}) : 18'sd0;
  endfunction

  function automatic [4:0] looks(input [70:0] word);
    looks = {word[1] ^ word[0], word[1:0] == voxmelt_pkg::SOLID ? word[21:18] : 4'd0};
  endfunction

  // What the neighbours at its sides, below and in front of it tell about the cell in register 1, and what
  // that cell tells about the one below.
  wire air1 = word1[1:0] == voxmelt_pkg::AIR, matter1 = word1[1] ^ word1[0];
  wire [2:0] open1 = {south_there & (south[1:0] == voxmelt_pkg::AIR), below_there & (word2[1:0] == voxmelt_pkg::AIR),
                      (west_there & (west[1:0] == voxmelt_pkg::AIR)) | (east_there & (east[1:0] == voxmelt_pkg::AIR))};
  wire sides1 = at_side | (west_there & west[1]) | (south_there & south[1]) | (east_there & east[1]);
  wire upright1 = at_end | (below_there & word2[1]);
  wire matter2 = word2[1] ^ word2[0];

  logic [15:0] weight_x2, weight_y2, weight_z2;
  pair_weight #(.MATERIALS(MATERIALS)) of_x (
      .clk(clk), .en(move), .p(looks(west)), .q(looks(word1)), .weights(weights), .weight(weight_x2));
  pair_weight #(.MATERIALS(MATERIALS)) of_y (
      .clk(clk), .en(move), .p(looks(word2)), .q(looks(word1)), .weights(weights), .weight(weight_y2));
  pair_weight #(.MATERIALS(MATERIALS)) of_z (
      .clk(clk), .en(move), .p(looks(south)), .q(looks(word1)), .weights(weights), .weight(weight_z2));
  product along_x (.clk(clk), .en(move), .a(drop_x2), .b({1'b0, weight_x2}), .p(product_x5));
  product along_y (.clk(clk), .en(move), .a(drop_y2), .b({1'b0, weight_y2}), .p(product_y5));
  product along_z (.clk(clk), .en(move), .a(drop_z2), .b({1'b0, weight_z2}), .p(product_z5));
  wire signed [34:0] rounded_x = product_x5 + $signed({19'd0, dither_x});
  wire signed [34:0] rounded_y = product_y5 + $signed({19'd0, dither_y});
  wire signed [34:0] rounded_z = product_z5 + $signed({19'd0, dither_z});
  assign west_flow6 = flow_x6;
  assign south_flow6 = flow_z6;

  logic [70:0] word3;
  delay #(.WIDTH(71), .N(3)) waits (.clk(clk), .en(move), .d(word3), .q(word6));
  wire matter6 = word6[1] ^ word6[0], matter7 = word7[1] ^ word7[0], matter8 = word8[1] ^ word8[0];
  wire [15:0] heat7 = word6[49:34] - flow_x6 + (east_there ? east_flow6 : 16'd0);

  always_ff @(posedge clk)
    if (move) begin
      word1 <= word_in;

      word2 <= word1;
      word2[68:66] <= matter1 ? open1 : 3'd0;
      word2[69] <= sides1;
      word2[70] <= sides1 | upright1;
      drop_x2 <= drop(west_there, west, word1);
      drop_y2 <= drop(below_there, word2, word1);
      drop_z2 <= drop(south_there, south, word1);

      word3 <= word2;
      if (below_there) begin
        word3[67] <= word2[67] | (air1 & matter2);
        word3[70] <= word2[70] | word1[1];
      end

      flow_x6 <= rounded_x[31:16];
      flow_y6 <= rounded_y[31:16];
      flow_z6 <= rounded_z[31:16];

      word7 <= word6;
      if (matter6) word7[49:34] <= heat7;
      both7 <= flow_y6 + flow_z6;
      flow_y7 <= flow_y6;

      word8 <= word7;
      if (matter7) word8[49:34] <= word7[49:34] - both7;

      word9 <= word8;
      if (matter8) word9[49:34] <= word8[49:34] + flow_y7;
    end
endmodule
