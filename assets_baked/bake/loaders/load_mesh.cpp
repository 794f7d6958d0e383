#include "assets_baked/bake/load_mesh.h"

#include "assets_baked/bake/loaders/load_bytes.h"
#include "assets_baked/bake/loaders/load_gltf.h"
#include "assets_baked/bake/loaders/load_obj.h"
#include "assets_baked/bake/loaders/load_ply.h"
#include "assets_baked/bake/loaders/load_stl.h"
#include "assets_baked/bake/loaders/model_file.h"
#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/trimmed.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string>

namespace frustumscreen {

namespace {

enum class Format { Gltf, Obj, Ply, Stl };

bool has_obj_line(std::string_view head) {
    constexpr std::size_t lines = 200;
    WordReader words(head);
    for (std::string_view keyword = words.next(); !keyword.empty() && words.line() < lines;
         keyword = words.next()) {
        if (keyword == "v" || keyword == "f" || keyword == "mtllib") {
            return true;
        }
        (void)words.rest_of_line();
    }
    return false;
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
    return extension;
}

/// The content decides first, because a file may have been renamed. STL and OBJ have no reliable mark, so for them the
/// extension decides.
Format format_of(ByteView file, const std::filesystem::path& path) {
    std::string_view head =
        as_text(file.subspan(0, std::min<std::size_t>(file.size(), std::size_t{64} * 1024)));
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    head.remove_prefix(head.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    const std::string_view first = trimmed(head);
    if (head.starts_with("glTF") || first.starts_with('{')) {
        return Format::Gltf;
    }
    if (head.starts_with("ply\n") || head.starts_with("ply\r") || head.starts_with("ply ")) {
        return Format::Ply;
    }
    if (has_length_of_binary_stl(file) || (first.starts_with("solid") && head.find("facet") != head.npos)) {
        return Format::Stl;
    }
    const std::string extension = lower_extension(path);
    if (extension == ".stl") {
        return Format::Stl;
    }
    if (extension == ".obj" || has_obj_line(head)) {
        return Format::Obj;
    }
    if (extension == ".ply") {
        refuse("mesh.no_ply", "it is not a PLY file, although its name says so (it does not begin with "
                              "\"ply\"); export it again");
    }
    if (extension == ".glb" || extension == ".gltf") {
        refuse("mesh.no_gltf", "it is not a glTF file, although its name says so (it begins neither with "
                               "\"glTF\" nor with a JSON object); export it again");
    }
    refuse("mesh.unknown_format",
           "it is neither glTF, OBJ, PLY nor STL; export it as one of these, best as .glb");
}

SourceMesh read(ByteView file, const std::filesystem::path& path, ModelFiles& files) {
    if (file.empty()) {
        refuse("mesh.empty_file", "the file is empty; copy it again, or export it again");
    }
    const auto named = [](SourceMesh mesh, const char* format) {
        mesh.contents.format = format;
        return mesh;
    };
    switch (format_of(file, path)) {
    case Format::Gltf:
        return named(load_gltf(file, files), as_text(file).starts_with("glTF") ? "GLB" : "glTF");
    case Format::Ply:
        return named(load_ply(file, files), "PLY");
    case Format::Stl:
        return named(load_stl(file, files), "STL");
    default:
        return named(load_obj(file, files), "OBJ");
    }
}

/// Applies the curator's own picture to a model that names none.
void wear_curators_picture(SourceMesh& mesh, PictureStore& pictures) {
    if (!mesh.textures.empty()) {
        return;
    }
    if (mesh.uvs.empty()) {
        refuse("mesh.no_texture_coordinates",
               "it has no texture coordinates, so no picture can be put on it: leave out --texture, or "
               "export it "
               "again with texture coordinates");
    }
    mesh.textures.push_back({pictures.curators()});
    for (SourceMaterial& material : mesh.materials) {
        material.texture = 0;
    }
}

SourceMesh load(ByteView file, const std::filesystem::path& path, const LoadOptions& options,
                const ModelFiles::Passed& passed) {
    ModelFiles files(path.parent_path(), options, passed);
    SourceMesh mesh = read(file, path, files);
    if (files.pictures.has_curators()) {
        wear_curators_picture(mesh, files.pictures);
        if (!files.pictures.used_curators()) {
            (void)files.pictures.curators(); // a wrong name is still an error
            files.notes.guessed("its own pictures are all there; {} is not used", options.texture.string());
        }
    }
    mesh.side_files = files.sidecars.files();
    if (!options.texture.empty()) {
        mesh.side_files.push_back(options.texture);
    }
    mesh.about = files.about;
    mesh.contents.picture_sizes = files.pictures.file_sizes();
    files.pictures.note_shrunk(files.notes);
    mesh.notes = files.notes.take();
    return mesh;
}

/// Makes an error one printable line, because names from the file may contain any bytes.
std::string one_line(std::string message) {
    constexpr std::size_t most = 500;
    for (char& c : message) {
        const auto code = static_cast<unsigned char>(c);
        c = code < 0x20 || code == 0x7f ? ' ' : c;
    }
    return message.size() <= most ? message : message.substr(0, most) + "...";
}

/// The result of `load`, which may throw.
template <typename Load> Result<SourceMesh> loaded(const std::filesystem::path& path, const Load& load) {
    const auto refused = [&](MessageId id, const std::string& message) {
        return bad_input(id, one_line(path.string() + ": " + message));
    };
    try {
        return load();
    } catch (const Refusal& refusal) {
        return refused(refusal.error.id, refusal.error.message);
    } catch (const std::bad_alloc&) {
        return refused(
            "mesh.no_memory",
            "it does not fit into this computer's memory; simplify it first, for instance in MeshLab");
    } catch (const std::exception& error) { // thrown by a library
        return refused("mesh.unreadable", std::string("cannot be read: ") + error.what());
    }
}

} // namespace

Result<SourceMesh> load_mesh_bytes(ByteView file, const std::filesystem::path& path,
                                   const LoadOptions& options) {
    return loaded(path, [&] { return load(file, path, options, [](std::size_t) {}); });
}

Result<SourceMesh> load_mesh(const std::filesystem::path& path, const LoadOptions& options) {
    return loaded(path, [&]() -> Result<SourceMesh> {
        Result<ModelFile> file = ModelFile::read(path);
        if (!file) {
            return bad_input(file.error().id, one_line(file.error().message));
        }
        const auto size = static_cast<double>(file->bytes().size());
        return load(file->bytes(), path, options, [&](std::size_t offset) {
            file->passed(offset);
            options.progress(static_cast<double>(offset) / size);
        });
    });
}

} // namespace frustumscreen
