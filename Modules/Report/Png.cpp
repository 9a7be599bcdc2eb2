// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <string>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Report/Picture.h"

namespace myotet::report {
namespace fs = std::filesystem;

namespace {

// libpng's image of the simplified interface, freed whatever happens.
struct Image {
    Image() { image.version = PNG_IMAGE_VERSION; }
    ~Image() { png_image_free(&image); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
    png_image image{};
};

[[noreturn]] void refuse(const fs::path& file, const char* what, const png_image& image) {
    throw IoError(file.string() + ": cannot be " + what + " as PNG (" + image.message +
                  "); check the file, its folder and the space left");
}

void describe(const Picture& picture, png_image& image) {
    MYOTET_CHECK(picture.width > 0 && picture.height > 0 &&
                     picture.rgb.size() == picture.offset(0, picture.height),
                 "a picture has three bytes a pixel");
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
}

}  // namespace

std::string encode_png(const Picture& picture) {
    Image png;
    describe(picture, png.image);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&png.image, bytes.data(), &size, 0, picture.rgb.data(), 0,
                                   nullptr))
        refuse("a picture", "written", png.image);
    bytes.resize(size);
    return bytes;
}

void write_png(const Picture& picture, const fs::path& file) {
    Image png;
    describe(picture, png.image);
    write_atomically(file, [&](const fs::path& temporary) {
        if (!png_image_write_to_file(&png.image, temporary.c_str(), 0, picture.rgb.data(), 0,
                                     nullptr))
            refuse(file, "written", png.image);
    });
}

Picture read_png(const fs::path& file) {
    Image png;
    if (!png_image_begin_read_from_file(&png.image, file.c_str())) refuse(file, "read", png.image);
    if (png.image.width > kLongestSide || png.image.height > kLongestSide)
        throw IoError(file.string() + ": a picture of " + std::to_string(png.image.width) + " x " +
                      std::to_string(png.image.height) + " pixels is beyond the longest side of " +
                      std::to_string(kLongestSide) + "; make it smaller");
    png.image.format = PNG_FORMAT_RGB;
    Picture picture = blank(static_cast<int>(png.image.width), static_cast<int>(png.image.height));
    const png_color white{255, 255, 255};
    if (!png_image_finish_read(&png.image, &white, picture.rgb.data(), 0, nullptr))
        refuse(file, "read", png.image);
    return picture;
}

}  // namespace myotet::report
