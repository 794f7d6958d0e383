#include "app/render/cast_pass.h"

#include "app/render/gl_memory.h"
#include "firmware_host/base/usable_cores.h"

#include <numeric>
#include <utility>

namespace frustumscreen {

Result<void> CastPass::prepare(std::size_t casts, int width, int height) {
    if (casts > 0 && !painter_) {
        painter_ = std::make_unique<ReliefPainter>(static_cast<int>(usable_cores()));
        memory_ = Image8(width, height);
    }
    while (pictures_.size() < casts) {
        Picture picture{GlTexture::generate(), {}};
        glBindTexture(GL_TEXTURE_2D, picture.texels.get());
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        if (glGetError() != GL_NO_ERROR) {
            return fail(
                ErrorKind::BadConfiguration,
                "render: the driver has no memory for a picture that is cast; use a technique of meshes");
        }
        pictures_.push_back(std::move(picture));
    }
    return {};
}

void CastPass::paint(const FramePlan& plan, const GpuStore& store) {
    for (std::size_t k = 0; k < pictures_.size(); ++k) {
        Picture& picture = pictures_[k];
        picture.lit = {};
        const BlockRelief* const relief =
            k < plan.cast_count ? store.find_relief(plan.casts[k].relief) : nullptr;
        if (relief == nullptr) {
            continue;
        }
        picture.lit = painter_->paint(*relief, plan.casts[k].view, plan.casts[k].samples,
                                      {memory_.texels.data(), memory_.width, memory_.height, memory_.width});
        if (!picture.lit.empty()) {
            upload(picture);
        }
    }
}

void CastPass::upload(const Picture& picture) const {
    const PixelRectangle& lit = picture.lit;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture.texels.get());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, memory_.width);
    glTexSubImage2D(GL_TEXTURE_2D, 0, lit.x, lit.y, lit.width, lit.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    &memory_.at(lit.x, lit.y));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

std::uint64_t CastPass::bytes() const {
    return std::accumulate(
        pictures_.begin(), pictures_.end(), std::uint64_t{0},
        [](std::uint64_t sum, const Picture& picture) { return sum + bytes_of_texture(picture.texels); });
}

} // namespace frustumscreen
