// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <mutex>
#include <utility>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "MeshFiles/Hdf5.h"

namespace myotet::meshfiles {
namespace {

/// Closes what HDF5 opened.
class Handle {
public:
    Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }
    [[nodiscard]] bool good() const { return id_ >= 0; }
    /// Closes now; false when that fails, as when the disk is full.
    [[nodiscard]] bool close() { return close_(std::exchange(id_, -1)) >= 0; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// HDF5 is built for one thread, and prints its errors unless told otherwise.
class Quiet {
public:
    Quiet() : lock_(mutex()) {
        H5Eget_auto2(H5E_DEFAULT, &before_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Quiet() { H5Eset_auto2(H5E_DEFAULT, before_, data_); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

private:
    static std::mutex& mutex() {
        static std::mutex one_at_a_time;
        return one_at_a_time;
    }
    std::lock_guard<std::mutex> lock_;
    H5E_auto2_t before_ = nullptr;
    void* data_ = nullptr;
};

bool write_table(hid_t file, const Table& table, hid_t stored_reals) {
    const bool real = table.integers.empty() && !table.reals.empty();
    const std::size_t count = real ? table.reals.size() : table.integers.size();
    const hsize_t shape[2] = {count / static_cast<hsize_t>(table.columns),
                              static_cast<hsize_t>(table.columns)};
    Handle space(H5Screate_simple(table.columns == 1 ? 1 : 2, shape, nullptr), H5Sclose);
    Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(how, false);  // the same mesh gives the same bytes
    Handle groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(groups, 1);
    Handle data(H5Dcreate2(file, table.name.c_str(), real ? stored_reals : H5T_STD_I32LE, space,
                           groups, how, H5P_DEFAULT),
                H5Dclose);
    if (!data.good()) return false;
    const void* from = real ? static_cast<const void*>(table.reals.data())
                            : static_cast<const void*>(table.integers.data());
    const hid_t type = real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32;
    return count == 0 || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, from) >= 0;
}

}  // namespace

void write_hdf5(std::span<const Table> tables, const std::filesystem::path& file) {
    write_hdf5(tables, 0, {}, file);
}

void write_hdf5(std::span<const Table> tables, std::size_t frames,
                const std::function<std::vector<FrameTable>(std::size_t)>& tables_of,
                const std::filesystem::path& file) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        const Quiet quiet;
        // The oldest format, which is the one that Hdf5Read.cpp knows.
        Handle how(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_libver_bounds(how, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
        Handle out(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, how), H5Fclose);
        bool good = out.good();
        for (const Table& table : tables) good = good && write_table(out, table, H5T_IEEE_F64LE);
        for (std::size_t f = 0; good && f < frames; ++f)
            for (const FrameTable& table : tables_of(f))
                good = good && write_table(out, {table.name, table.columns, table.reals, {}},
                                           H5T_IEEE_F32LE);
        if (!good || !out.close())
            throw IoError(file.string() +
                          ": cannot be written; check that the folder exists, may be written to "
                          "and has space left");
    });
}

}  // namespace myotet::meshfiles
