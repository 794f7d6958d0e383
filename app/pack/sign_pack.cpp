#include "app/pack/sign_pack.h"

#include "app/pack/manifest.h"
#include "app/pack/zip_archive.h"

namespace frustumscreen {

using namespace pack_format;

Result<Bytes> with_signature(std::span<const std::byte> pack, std::string_view signature) {
    Result<ZipReader> from = ZipReader::open(pack);
    if (!from) {
        return tl::unexpected<Error>(from.error());
    }
    ZipWriter to;
    for (const ZipEntry& entry : from->entries()) {
        if (entry.name == signature_name) {
            continue;
        }
        if (const Result<void> copied = to.copy(*from, entry); !copied) {
            return tl::unexpected<Error>(copied.error());
        }
    }
    to.add(std::string(signature_name), as_bytes(signature), Packing::Stored);
    return to.finish();
}

} // namespace frustumscreen
