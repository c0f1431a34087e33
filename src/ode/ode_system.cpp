#include "suture/ode/ode_system.hpp"

#include "threads/worker_pool.hpp"

namespace suture {

WorkerPool& OdeSystem::workers() { return WorkerPool::alone(); }

}  // namespace suture
