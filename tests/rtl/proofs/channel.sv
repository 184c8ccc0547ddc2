// A bounded stream. One word is followed, any one: it leaves once, in its order, as it came. Words have one bit, as
// the channel does not look at them.
module proof (
    input logic clk,
    input logic rst,
    input logic in_valid,
    input logic in_word,
    input logic out_ready,
    input logic chosen
);
  localparam DEPTH = 4;
  logic in_ready, out_valid, out_word;
  logic [1:0] head, tail;
  logic [2:0] count;
  logic word0, word1, word2, word3;
  channel dut (
      .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .in_word(in_word), .out_valid(out_valid),
      .out_ready(out_ready), .out_word(out_word), .head(head), .tail(tail), .count(count), .\words[0] (word0),
      .\words[1] (word1), .\words[2] (word2), .\words[3] (word3));
  initial assume (rst);
  wire put = in_valid & in_ready, get = out_valid & out_ready;

  // The followed word has `ahead` words before it.
  logic follows, value, was_offered, offered_word;
  logic [2:0] ahead;
  wire leaves = follows & get & ahead == 3'd0;
  always_ff @(posedge clk)
    if (rst) follows <= 1'b0;
    else if (~follows & put & chosen) begin
      follows <= 1'b1;
      value <= in_word;
      ahead <= count - 3'(get);
    end else if (leaves) follows <= 1'b0;
    else if (follows & get) ahead <= ahead - 3'd1;
  always_ff @(posedge clk) begin
    was_offered <= out_valid & ~out_ready & ~rst;
    offered_word <= out_word;
  end

  wire [3:0] words = {word3, word2, word1, word0};
  wire [1:0] place = head + ahead[1:0];
  logic [7:0] age;
  moves time_ (.clk(clk), .age(age));
  always_comb if (age != 8'd0) begin
    never_overflows: assert (count <= 3'd4);
    ends_meet: assert (tail == 2'(head + count[1:0]));
    stays_in_the_channel: assert (~follows | ahead < count);
    stays_as_it_came: assert (~follows | words[place] == value);
    leaves_as_it_came: assert (~leaves | out_word == value);
    offered_until_taken: assert (~was_offered | (out_valid & out_word == offered_word));
    full_or_ready: assert (in_ready == (count != 3'd4));
  end
endmodule
