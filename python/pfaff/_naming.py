"""Names as plug-ins have them."""


def kebab(name: str) -> str:
    """A name in kebab-case: DampedPendulum and damped_pendulum are damped-pendulum.

    >>> kebab("DampedPendulum"), kebab("my_rule")
    ('damped-pendulum', 'my-rule')
    """
    words = "".join("-" + c if c.isupper() and k and not name[k - 1].isupper() else c for k, c in enumerate(name))
    return words.lower().replace("_", "-").strip("-")
