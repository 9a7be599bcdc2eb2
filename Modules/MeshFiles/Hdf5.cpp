// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Hdf5.h"

#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"

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

/// HDF5 is built for one thread, and prints its errors unless told otherwise;
/// so it does when the program ends, where a damaged file made it lose handles.
class Quiet {
public:
    Quiet() : lock_(mutex()) {
        [[maybe_unused]] static const herr_t told = H5dont_atexit();  // before any other call of it
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

bool write_table(hid_t file, const Table& table) {
    const bool real = table.integers.empty() && !table.reals.empty();
    const std::size_t count = real ? table.reals.size() : table.integers.size();
    const hsize_t shape[2] = {count / static_cast<hsize_t>(table.columns),
                              static_cast<hsize_t>(table.columns)};
    Handle space(H5Screate_simple(table.columns == 1 ? 1 : 2, shape, nullptr), H5Sclose);
    Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(how, false);  // the same mesh gives the same bytes
    Handle data(H5Dcreate2(file, table.name.c_str(), real ? H5T_IEEE_F64LE : H5T_STD_I32LE, space,
                           H5P_DEFAULT, how, H5P_DEFAULT),
                H5Dclose);
    if (!data.good()) return false;
    const void* from = real ? static_cast<const void*>(table.reals.data())
                            : static_cast<const void*>(table.integers.data());
    const hid_t type = real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32;
    return count == 0 || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, from) >= 0;
}

/// A damaged header may ask for more than the file can hold: this is what it
/// can. Only chunks can be compressed, by zlib to one byte of 1040 at best.
hsize_t most_bytes(hid_t data, const std::filesystem::path& file) {
    const Handle how(H5Dget_create_plist(data), H5Pclose);
    const hsize_t stored =
        std::min<hsize_t>(H5Dget_storage_size(data), std::filesystem::file_size(file));
    return H5Pget_layout(how) == H5D_CHUNKED ? 1040 * stored : stored;
}

template <class Number>
std::vector<Number> read_table(const std::filesystem::path& file, const std::string& dataset,
                               std::int64_t columns, hid_t type) {
    const std::string where = file.string() + ": dataset '" + dataset + "' ";
    const auto cannot = [&] {
        return IoError(where +
                       "cannot be read; keep the .h5 beside its .xdmf, or write both again");
    };
    Handle in(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!in.good()) throw cannot();
    Handle data(H5Dopen2(in, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    if (!data.good()) throw cannot();
    Handle stored(H5Dget_type(data), H5Tclose);
    const H5T_class_t kind = H5Tget_class(stored);
    const std::size_t bytes = H5Tget_size(stored);
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || bytes == 0 || bytes > 8)
        throw InputError(where +
                         "holds no numbers of at most 64 bits; the file is damaged or not a mesh, "
                         "write it again");
    Handle space(H5Dget_space(data), H5Sclose);
    hsize_t shape[2] = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, shape, nullptr);
    if ((rank != 1 && rank != 2) || static_cast<std::int64_t>(shape[1]) != columns)
        throw InputError(where + "has not " + std::to_string(columns) +
                         " columns; the file is damaged or not a mesh, write it again");
    if (shape[0] > most_bytes(data, file) / (shape[1] * bytes)) throw cannot();
    std::vector<Number> numbers(shape[0] * shape[1]);
    if (!numbers.empty() && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
        throw cannot();
    return numbers;
}

}  // namespace

void write_hdf5(std::span<const Table> tables, const std::filesystem::path& file) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        const Quiet quiet;
        Handle out(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        bool good = out.good();
        for (const Table& table : tables) good = good && write_table(out, table);
        if (!good || !out.close())
            throw IoError(file.string() +
                          ": cannot be written; check that the folder exists, may be written to "
                          "and has space left");
    });
}

std::vector<double> read_reals(const std::filesystem::path& file, const std::string& dataset,
                               std::int64_t columns) {
    const Quiet quiet;
    return read_table<double>(file, dataset, columns, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> read_integers(const std::filesystem::path& file,
                                        const std::string& dataset, std::int64_t columns) {
    const Quiet quiet;
    return read_table<std::int64_t>(file, dataset, columns, H5T_NATIVE_INT64);
}

}  // namespace myotet::meshfiles
