"""The planner: decisions at once and late, their costs, and forks for single views."""

from hlr.request.effect import PLAN, SCENE, Decision, Effect, Facts, Planner


def test_the_planner_remembers_and_forks():
    table = (
        Effect("costly", SCENE, lambda f, o: (f.groups > 1, f"{f.groups} groups"), ("steps",)),
        Effect("wish", "asked", lambda f, o: (bool(o), "as wished"), ()),
    )
    planner = Planner(table, options=False)
    assert not planner.on("costly", Facts(groups=1)) and not planner.on("wish")
    fork = planner.fork()
    assert fork.on("costly", Facts(groups=2))
    fork.spent("costly", 0.5, steps=3)
    fork.spent("costly", 0.25, steps=4)
    costly, wish, last = fork.decisions()
    assert costly == Decision("costly", True, SCENE, "2 groups", 0.75, {"steps": 7})
    assert (wish.on, last.name) == (False, PLAN)
    assert not planner.decisions()[0].on
    forced = Planner(table, options=False, force=True)
    assert forced.on("costly", Facts(groups=1)) and not forced.on("wish")


def test_what_is_stated_is_decided_when_somebody_reads_it():
    asked = []
    table = (Effect("late", SCENE, lambda f, o: (asked.append(f.groups) or f.groups > 1, f"{f.groups} groups"), ()),)
    planner = Planner(table, options=False)
    planner.state(Facts(groups=1), "late")
    assert not asked, "nobody has read it"
    fork = planner.fork()
    fork.state(Facts(groups=2), "late")
    assert [(d.on, d.reason) for d in fork.decisions()[:-1]] == [(True, "2 groups")]
    assert [(d.on, d.reason) for d in planner.decisions()[:-1]] == [(False, "1 groups")], "the fork is its own"
    # The last word counts, whichever it is.
    assert planner.on("late", Facts(groups=3)) and planner.decisions()[0].reason == "3 groups"
    planner.state(Facts(groups=4), "late")
    assert planner.decisions()[0].reason == "4 groups"
    planner.revised("late", False, "it proved wrong")
    assert planner.decisions()[0].reason == "it proved wrong"
