#include "render/device/kernels.h"

#include <string>
#include <utility>

#include "kernel/engine/gpu/constants.h"
#include "render/device/program_text.h"

namespace voxmelt::render {

PictureKernels::PictureKernels(std::shared_ptr<gpu::Device> device, const gpu::Shape* shape)
    : device_(std::move(device)),
      kernels_(device_->build({program_text(), kPictureKernelNames,
                               shape != nullptr ? gpu::specialised_options(*shape) : std::string()})) {}

}  // namespace voxmelt::render
