#include "SceneLoader.h"

#include <utility>

#include "ViewLoading.h"

namespace weft {

SceneLoader::~SceneLoader() {
  if (job_) job_->stopped = true;  // its thread is joined with it
}

void SceneLoader::start(ViewRequest request) {
  std::erase_if(givenUp_, [](const auto& job) { return job->done.load(); });
  if (job_) {
    job_->stopped = true;
    givenUp_.push_back(std::move(job_));
  }
  job_ = std::make_shared<Job>();
  Job& job = *job_;  // outlives its thread
  ViewLoading::Listener listener;
  listener.stopped = [&job] { return job.stopped.load(); };
  listener.doing = [this, &job](std::string what) {
    const std::scoped_lock lock(job.mutex);
    if (std::exchange(job.doing, what) != what) wake_();
  };
  listener.loaded = [this, &job](Result<LoadedView> view) {
    const std::scoped_lock lock(job.mutex);
    job.loaded.push_back(std::move(view));
    wake_();
  };
  job.thread = std::jthread([&job, loading = ViewLoading(std::move(request), std::move(listener))]() mutable {
    loading.run();
    job.done = true;
  });
}

std::optional<Result<LoadedView>> SceneLoader::take() {
  if (!job_) return std::nullopt;
  const std::scoped_lock lock(job_->mutex);
  if (job_->loaded.empty()) return std::nullopt;
  Result<LoadedView> first = std::move(job_->loaded.front());
  job_->loaded.erase(job_->loaded.begin());
  return first;
}

std::string SceneLoader::doing() const {
  if (!job_ || job_->done) return {};
  const std::scoped_lock lock(job_->mutex);
  return job_->doing;
}

}  // namespace weft
