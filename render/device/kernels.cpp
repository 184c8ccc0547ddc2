#include "render/device/kernels.h"

#include <utility>

#include "render/device/program_text.h"

namespace voxmelt::render {

PictureKernels::PictureKernels(std::shared_ptr<gpu::Device> device)
    : device_(std::move(device)), kernels_(device_->build({program_text(), kPictureKernelNames})) {}

}  // namespace voxmelt::render
