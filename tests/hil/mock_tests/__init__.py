"""Tests of the mocks: compare their bytes with bytes put together by hand."""
