"""Callbacks that watch an integration, until they are removed."""
import gc
import pathlib
import weakref

import pytest
from definitions import duffing

import pfaff


def test_a_callback_is_removed():
    it, seen, others = pfaff.Integration(duffing, "verlet", step=0.5), [], []
    watching = it.watch(lambda t, z: seen.append(t))
    it.watch(lambda t, z: others.append(t), every=2)
    it.steps(2)
    watching.remove()
    watching.remove()
    it.steps(2)
    assert seen == [0.5, 1.0] and others == [1.0, 2.0]
    with it.watch(lambda t, z: seen.append(t)) as again:
        it.steps(1)
    with pytest.raises(LookupError), it.watch(lambda t, z: seen.append(t)):
        raise LookupError
    it.steps(1)
    assert repr(again) == "<callback of <integration of duffing by verlet, step 0.5, at t = 3>>"
    assert isinstance(again, pfaff.Watching) and seen == [0.5, 1.0, 2.5] and others[-1] == 3.0


def test_a_callback_is_removed_while_steps_are_taken():
    it, seen, others = pfaff.Integration(duffing, "verlet", step=0.5), [], []

    def once(t, z):
        seen.append(t)
        if t == 1.5:
            itself.remove()
            behind.remove()

    itself = it.watch(once)
    behind = it.watch(lambda t, z: others.append(t))
    it.steps(1000)  # some blocks of states
    assert seen == [0.5, 1.0, 1.5] and others == [0.5, 1.0]
    kept = it.steps(10, every=5)
    assert kept.t.tolist() == [502.5, 505.0] and it.time == 505 and seen[-1] == 1.5


def test_what_a_call_kept_does_not_cost_later_calls():
    """A processed method takes its processor wherever somebody looks."""
    processed = pathlib.Path(__file__).resolve().parents[2] / "examples" / "tables" / "blanes-processed-6.toml"
    it, alone = (pfaff.Integration("kepler", processed, step=0.01) for _ in range(2))
    it.steps(100, every=1)
    watched = it.counters["right_hand_sides"]
    it.steps(100)
    alone.steps(100)
    assert it.counters["right_hand_sides"] - watched == alone.counters["right_hand_sides"] < watched


def test_no_callback_sees_a_state_behind_the_end():
    it, first, second = pfaff.Integration("kepler", "verlet", step=0.01), [], []
    it.watch(lambda t, z: first.append(("a", t)))
    it.watch(lambda t, z: second.append(t) or t > 0.029)
    it.watch(lambda t, z: first.append(("c", t)), every=2)
    it.steps(1000)
    assert it.steps_taken == 3 and it.time == 0.03
    assert [name for name, _ in first] == ["a", "a", "c", "a"]
    assert [round(t, 3) for t in second] == [0.01, 0.02, 0.03]


def test_an_integration_goes_with_callbacks_that_hold_it():
    class Recorder:
        def __init__(self):
            self.seen, self.it = [], pfaff.Integration("kepler", "verlet", step=0.1)
            self.it.watch(self.see)

        def see(self, t, z):
            self.seen.append(t)

    recorder = Recorder()
    recorder.it.steps(3)
    assert len(recorder.seen) == 3
    left = weakref.ref(recorder)
    del recorder
    gc.collect()
    assert left() is None
