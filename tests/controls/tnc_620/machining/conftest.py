"""What these tests share with those of the strategies of the core."""

from t3_machining.conftest import trace

__all__ = ["trace"]
