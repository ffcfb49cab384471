#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "bench/peers/stand_events.h"

namespace sinew::bench {

namespace {

class Cvode {
 public:
  explicit Cvode(double tolerance) {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(4, context_);
    seen_ = N_VClone(state_);
    absolute_ = N_VClone(state_);
    for (int i = 0; i < 4; ++i) NV_Ith_S(absolute_, i) = tolerance * scale_of_state[i];
    matrix_ = SUNDenseMatrix(4, 4, context_);
    solver_ = SUNLinSol_Dense(state_, matrix_, context_);
    memory_ = CVodeCreate(CV_BDF, context_);
    CVodeInit(memory_, right, 0, state_);
    CVodeSVtolerances(memory_, tolerance, absolute_);
    CVodeSetUserData(memory_, this);
    CVodeSetLinearSolver(memory_, solver_, matrix_);
  }
  ~Cvode() {
    CVodeFree(&memory_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    for (const N_Vector v : {state_, seen_, absolute_}) N_VDestroy(v);
    SUNContext_Free(&context_);
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  void restart(double t, const StandState& x, int side, int valve) {
    side_ = side;
    valve_ = valve;
    for (int i = 0; i < 4; ++i) NV_Ith_S(state_, i) = x[static_cast<std::size_t>(i)];
    CVodeReInit(memory_, t, state_);
  }
  double one_step(double until) {
    CVodeSetStopTime(memory_, until);
    double t = until;
    if (CVode(memory_, until, state_, &t, CV_ONE_STEP) < 0) return until;
    return t;
  }
  StandState state_at(double t) {
    CVodeGetDky(memory_, t, 0, seen_);
    StandState x;
    for (int i = 0; i < 4; ++i) x[static_cast<std::size_t>(i)] = NV_Ith_S(seen_, i);
    return x;
  }

 private:
  static int right(double, N_Vector x, N_Vector rates, void* self) {
    const auto& me = *static_cast<const Cvode*>(self);
    appendix_a_rates(me.valve_, me.side_, NV_DATA_S(x), NV_DATA_S(rates));
    return 0;
  }

  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr, seen_ = nullptr, absolute_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* memory_ = nullptr;
  int side_ = 0, valve_ = 1;
};

void simulate(double tolerance, int every, Lengths& lengths) {
  Cvode stepper(tolerance);
  StandRun().go(stepper, every, lengths);
}

}  // namespace

StandPeer cvode_stand() { return {"cvode", SUNDIALS_VERSION, simulate}; }

}  // namespace sinew::bench
