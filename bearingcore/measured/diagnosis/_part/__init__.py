"""Diagnosis of the damaged part of a bearing."""
