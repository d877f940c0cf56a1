"""Namespaces: the public names by theme, such as ``tg.loads`` and ``tg.measures``, one file each."""
