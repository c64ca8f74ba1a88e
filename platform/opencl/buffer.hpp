#pragma once

#include <CL/opencl.hpp>
#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "platform/opencl/device.hpp"
#include "platform/opencl/device_error.hpp"

namespace touchstone {

/// A mapped range of a buffer; unmapped at the end of the scope. On a CPU device nothing is copied.
template <class T>
class Mapped {
  public:
    Mapped(const Device& device, const cl::Buffer& buffer, cl_map_flags flags, std::size_t count)
        : queue_(device.queue()), buffer_(buffer) {
        try {
            void* data =
                queue_.enqueueMapBuffer(buffer_, CL_TRUE, flags, 0, count * sizeof(std::remove_const_t<T>));
            data_ = {static_cast<T*>(data), count};
        } catch (const cl::Error& error) {
            throw DeviceError("mapping a buffer", error.err(), device.name());
        }
    }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;
    Mapped(Mapped&& other) noexcept : queue_(other.queue_), buffer_(other.buffer_), data_(other.data_) {
        other.data_ = {};
    }
    Mapped& operator=(Mapped&&) = delete;
    ~Mapped() {
        if (data_.empty()) return;
        using Mutable = std::remove_const_t<T>;
        (void)clEnqueueUnmapMemObject(queue_(), buffer_(), const_cast<Mutable*>(data_.data()), 0, nullptr,
                                      nullptr);
    }

    std::span<T> values() const { return data_; }
    T& operator[](std::size_t index) const { return data_[index]; }
    std::size_t size() const { return data_.size(); }

  private:
    cl::CommandQueue queue_;
    cl::Buffer buffer_;
    std::span<T> data_;
};

/// Device memory for `size()` values of T.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;
    Buffer(const Device& device, std::size_t count) : device_(&device), count_(count) {
        const std::size_t bytes = count * sizeof(T);
        const cl_mem_flags place = device.shares_memory() ? CL_MEM_ALLOC_HOST_PTR : 0;
        try {
            // Drivers that give memory only when it is used (NVIDIA's) refuse nothing here.
            if (bytes > device.memory_bytes()) throw cl::Error(CL_INVALID_BUFFER_SIZE, "clCreateBuffer");
            buffer_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE | place, bytes);
        } catch (const cl::Error& error) {
            throw DeviceError("allocating " + std::to_string(bytes) + " bytes", error.err(), device.name());
        }
    }
    Buffer(const Device& device, std::span<const T> values) : Buffer(device, values.size()) { write(values); }

    std::size_t size() const { return count_; }
    const cl::Buffer& handle() const { return buffer_; }

    Mapped<const T> map_read() const { return map_read(count_); }
    Mapped<const T> map_read(std::size_t count) const { return {*device_, buffer_, CL_MAP_READ, count}; }
    Mapped<T> map_write() { return {*device_, buffer_, CL_MAP_WRITE_INVALIDATE_REGION, count_}; }
    Mapped<T> map_update() { return {*device_, buffer_, CL_MAP_READ | CL_MAP_WRITE, count_}; }

    void write(std::span<const T> values) {
        if (values.empty()) return;
        check("writing a buffer", [&] {
            device_->queue().enqueueWriteBuffer(buffer_, CL_TRUE, 0, values.size_bytes(), values.data());
        });
    }
    std::vector<T> read() const {
        std::vector<T> values(count_);
        if (count_ > 0) std::ranges::copy(map_read().values(), values.begin());
        return values;
    }
    void fill(T value) {
        check("filling a buffer",
              [&] { device_->queue().enqueueFillBuffer(buffer_, value, 0, count_ * sizeof(T)); });
    }
    /// The first min(size) values of `other`, on the device.
    void copy_from(const Buffer& other) {
        const std::size_t bytes = std::min(count_, other.count_) * sizeof(T);
        check("copying a buffer",
              [&] { device_->queue().enqueueCopyBuffer(other.buffer_, buffer_, 0, 0, bytes); });
    }

  private:
    template <class Call>
    void check(const char* what, Call&& call) const {
        try {
            call();
        } catch (const cl::Error& error) {
            throw DeviceError(what, error.err(), device_->name());
        }
    }

    const Device* device_ = nullptr;
    cl::Buffer buffer_;
    std::size_t count_ = 0;
};

}  // namespace touchstone
