// A stage in SystemVerilog stands in the place of its model. Its tokens are compared like those of any
// other stage, by their ordinals. It gives them later, since it has registers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/rtl/host/rtl_model.h"

namespace voxmelt::hwmodel {

class RtlStage final : public Stage {
 public:
  // `model` says what side bands the stage has, and what it costs.
  RtlStage(std::unique_ptr<Stage> model, std::unique_ptr<RtlModel> rtl);

  bool cycle() override;
  void feed(HeatFifo& feed) override {
    if (kind() == StageKind::exchange) feed_ = &feed;
  }

  void feed_falls(FallFifo& feed) override {
    if (kind() == StageKind::fall) falls_ = &feed;
  }

  Wires side_bands() const override { return model_->side_bands(); }
  int width_of(Wire wire) const override { return model_->width_of(wire); }
  int output_bits() const override { return model_->output_bits(); }
  std::vector<BufferCost> buffers() const override { return model_->buffers(); }
  Units units() const override { return model_->units(); }

 private:
  void advance(const Cell* /*in*/, Cell* /*out*/) override {}
  void reset();
  bool follows() const;
  void take(const Cell* in);
  void take_falls(const UInt<1>* falls);
  void take_shows(const Cell* in);
  void take_substep(const step::Moment& moment);
  void take_irradiance(const UInt<16>* irradiance);
  void give(Cell* out) const;
  void give_shows(Cell* out) const;
  bool hand_on();
  void count_left();

  std::unique_ptr<Stage> model_;
  std::unique_ptr<RtlModel> rtl_;
  bool is_viscous_ = false, takes_runs_ = false;               // is it told of sub-steps, and of runs?
  std::uint32_t *in_cells_ = nullptr, *irradiance_ = nullptr;  // ports
  HeatFifo* feed_ = nullptr;
  FallFifo* falls_ = nullptr;
};

// Returns why the pipeline of a design cannot have stages in SystemVerilog, or "" if it can. If `only` is not
// empty, it looks at the stages of these names.
std::string rtl_refusal(const Design& design, const std::vector<std::string>& only = {});
// Makes the stages in SystemVerilog that there are. If `only` is not empty, it makes those of these names.
StageMaker rtl_stages(std::vector<std::string> only = {}, int seed = 1);

}  // namespace voxmelt::hwmodel
