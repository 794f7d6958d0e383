// `open`, `close`, `mmap` and `munmap` of the tested code, by the linker's --wrap: calls for a fake card go
// to the fake kernel.
#include "tests/display/fake_kernel.h"

#include <fcntl.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstdarg>

using frustumscreen::display::FakeFile;
using frustumscreen::display::FakeKernel;

extern "C" {

int __real_open(const char* path, int flags, ...);
int __real_close(int file);
void* __real_mmap(void* at, size_t length, int protection, int flags, int file, off_t offset);
int __real_munmap(void* at, size_t length);

int __wrap_open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const auto mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : mode_t{0};
    va_end(arguments);
    if (!FakeKernel::is_there()) {
        return __real_open(path, flags, mode);
    }
    FakeKernel& kernel = FakeKernel::instance();
    frustumscreen::display::FakeCard* const card = kernel.card_at(path);
    const frustumscreen::display::FakeGpu* const gpu = kernel.gpu_at(path);
    if (card == nullptr && gpu == nullptr) {
        return __real_open(path, flags, mode);
    }
    errno = kernel.enter("open");
    if (errno == 0 && card != nullptr && card->gone) {
        errno = ENODEV;
    }
    return errno == 0 ? kernel.open_file(card, gpu, flags) : -1;
}

int __wrap_close(int file) {
    if (FakeKernel::is_there()) {
        FakeKernel::instance().close_file(file);
    }
    return __real_close(file);
}

void* __wrap_mmap(void* at, size_t length, int protection, int flags, int file, off_t offset) {
    FakeFile* const opened = FakeKernel::is_there() ? FakeKernel::instance().file(file) : nullptr;
    if (opened == nullptr) {
        return __real_mmap(at, length, protection, flags, file, offset);
    }
    FakeKernel& kernel = FakeKernel::instance();
    const frustumscreen::display::FakeBuffer* const buffer =
        opened->card->buffer(*opened, static_cast<std::uint32_t>(offset >> 12U));
    errno = kernel.enter("mmap");
    if (errno == 0 && (buffer == nullptr || length > buffer->memory->size())) {
        errno = EINVAL;
    }
    if (errno != 0) {
        return MAP_FAILED;
    }
    kernel.hand_out(buffer->memory->data(), "mapping", buffer->memory);
    return buffer->memory->data();
}

int __wrap_munmap(void* at, size_t length) {
    if (FakeKernel::is_there() && FakeKernel::instance().handed_out(at)) {
        FakeKernel::instance().give_back(at, "mapping");
        return 0;
    }
    return __real_munmap(at, length);
}

} // extern "C"
