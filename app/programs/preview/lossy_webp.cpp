#include "app/programs/preview/lossy_webp.h"

#include <webp/encode.h>

#include <memory>

namespace frustumscreen {

namespace {

struct FreePicture {
    void operator()(WebPPicture* picture) const {
        WebPPictureFree(picture);
        delete picture;
    }
};

} // namespace

Bytes encode_lossy_webp(const Image8& image, float quality) {
    WebPConfig config;
    const std::unique_ptr<WebPPicture, FreePicture> picture(new WebPPicture{});
    if (WebPConfigPreset(&config, WEBP_PRESET_PHOTO, quality) == 0 || WebPPictureInit(picture.get()) == 0 ||
        image.texels.empty()) {
        return {};
    }
    picture->width = image.width;
    picture->height = image.height;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture->writer = WebPMemoryWrite;
    picture->custom_ptr = &writer;
    Bytes bytes;
    if (WebPPictureImportRGBX(picture.get(), &image.texels[0].x, 4 * image.width) != 0 &&
        WebPEncode(&config, picture.get()) != 0) {
        const auto* begin = reinterpret_cast<const std::byte*>(writer.mem);
        bytes.assign(begin, begin + writer.size);
    }
    WebPMemoryWriterClear(&writer);
    return bytes;
}

} // namespace frustumscreen
