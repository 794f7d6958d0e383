#include "app/pack/sign_pack.h"

#include "app/pack/container/zip_archive.h"
#include "app/pack/manifest.h"
#include "firmware_host/base/streamed_file.h"

namespace frustumscreen::pack {

namespace {

Result<void> copy_with_signature(Result<ZipReader> from, ZipWriter& to, std::string_view signature) {
    TRY_VOID(from);
    for (const ZipEntry& entry : from->entries()) {
        if (entry.name == signature_name) {
            continue;
        }
        TRY_VOID(to.copy(*from, entry));
    }
    to.add(std::string(signature_name), as_bytes(signature), Packing::Stored);
    return {};
}

} // namespace

Result<Bytes> with_signature(std::span<const std::byte> pack, std::string_view signature) {
    ZipWriter to;
    return copy_with_signature(ZipReader::open(pack), to, signature).and_then([&] { return to.finish(); });
}

Result<void> write_with_signature(OpenFile pack, std::string_view signature,
                                  const std::filesystem::path& file) {
    return write_file_with(file, [&](int descriptor) {
        ZipWriter to(descriptor);
        return at(file.string(),
                  copy_with_signature(ZipReader::open(std::move(pack)), to, signature).and_then([&] {
                      return to.finish_file();
                  }));
    });
}

} // namespace frustumscreen::pack
