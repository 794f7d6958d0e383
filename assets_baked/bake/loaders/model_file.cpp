#include "assets_baked/bake/loaders/model_file.h"

#include "firmware_host/base/open_file.h"

#include <sys/mman.h>

#include <new>
#include <span>

namespace frustumscreen::bake {

void UnmapPages::operator()(std::byte* memory) const {
    ::munmap(memory, size);
}

Result<ModelFile> ModelFile::read(const std::filesystem::path& path) {
    TRY(const OpenFile file, OpenFile::open(path, max_model_bytes));
    ModelFile read;
    read.size_ = static_cast<std::size_t>(file.bytes());
    if (read.size_ == 0) {
        return read;
    }
    void* const memory =
        ::mmap(nullptr, read.size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        throw std::bad_alloc();
    }
    read.memory_ = {static_cast<std::byte*>(memory), UnmapPages{read.size_}};
    if (!file.read(0, std::span(read.memory_.get(), read.size_))) {
        return bad_input("mesh.file_shortened",
                         path.string() + ": cannot be read: it became shorter, or its disk fails");
    }
    return read;
}

void ModelFile::passed(std::size_t offset) {
    constexpr std::size_t step = std::size_t{16} << 20U; // a multiple of every page's size
    const std::size_t end = offset - offset % step;
    if (end > given_back_ && end <= size_) {
        ::madvise(memory_.get() + given_back_, end - given_back_, MADV_DONTNEED);
        given_back_ = end;
    }
}

} // namespace frustumscreen::bake
