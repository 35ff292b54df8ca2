// SPDX-License-Identifier: BSD-3-Clause
#include "io/blob_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

// Calls step(done), which reads or writes the bytes after `done` and returns their number, until
// `size` bytes are done. Returns 0 or an error number.
template <class Step>
int repeat(std::size_t size, Step&& step) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t now = step(done);
    if (now < 0 && errno == EINTR) continue;
    if (now < 0) return errno;
    if (now == 0) return EIO;  // the file was truncated
    done += static_cast<std::size_t>(now);
  }
  return 0;
}

}  // namespace

BlobFile::BlobFile(std::filesystem::path path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) fail("written", errno);
}

BlobFile::~BlobFile() {
  ::close(file_);
  ::unlink(path_.c_str());
}

void BlobFile::append(std::span<const std::byte> bytes) {
  const bool full =
      !overflow_.empty() || repeat(bytes.size(), [&](std::size_t done) {
                              return ::pwrite(file_, bytes.data() + done, bytes.size() - done,
                                              static_cast<off_t>(in_file_ + done));
                            }) != 0;
  if (full)
    overflow_.insert(overflow_.end(), bytes.begin(), bytes.end());
  else
    in_file_ += bytes.size();
}

void BlobFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (bytes.empty()) return;
  if (offset >= in_file_) {  // one call's bytes are in one place
    std::memcpy(bytes.data(), overflow_.data() + (offset - in_file_), bytes.size());
    return;
  }
  const int error = repeat(bytes.size(), [&](std::size_t done) {
    return ::pread(file_, bytes.data() + done, bytes.size() - done,
                   static_cast<off_t>(offset + done));
  });
  if (error) fail("read", error);
}

void BlobFile::clear() {
  if (::ftruncate(file_, 0) != 0) fail("written", errno);
  in_file_ = 0;
  overflow_.clear();
}

void BlobFile::fail(const char* what, int error) const {
  throw InputError(path_.string() + ": cannot be " + what + " (" + std::strerror(error) +
                   "); free space or choose another folder with -o");
}

}  // namespace lego_loam_sc
