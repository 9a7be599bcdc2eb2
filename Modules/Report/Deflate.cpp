// SPDX-License-Identifier: Apache-2.0
#include "Report/Deflate.h"

#include <zlib.h>

#include "Core/Errors.h"

namespace myotet::report {

std::string deflated(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()),
                                 static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
    MYOTET_CHECK(status == Z_OK, "zlib packs what it has room for");
    packed.resize(size);
    return packed;
}

}  // namespace myotet::report
