#include "firmware_host/base/tree_text.h"

#include "firmware_host/base/file.h"

#include <cerrno>

namespace frustumscreen {

FileResult<std::string> read_text(FileTree& tree, std::string_view path, std::size_t max_bytes) {
    TRY(const std::unique_ptr<const FileContent> file, tree.open(std::string(path)));
    if (file->bytes() > max_bytes) {
        return file_fault(EFBIG);
    }
    std::string text(file->bytes(), '\0');
    if (const int fault = file->read(0, std::as_writable_bytes(std::span(text))); fault != 0) {
        return file_fault(fault);
    }
    return text;
}

FileResult<void> replace_text(WritableTree& tree, std::string_view path, std::string_view next,
                              std::string_view text) {
    {
        TRY(const std::unique_ptr<NewFile> created, tree.create(std::string(next)));
        TRY_VOID(created->append(as_bytes(text)).and_then([&] { return created->sync(); }));
    }
    return tree.rename(std::string(next), std::string(path));
}

} // namespace frustumscreen
