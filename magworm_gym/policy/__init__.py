"""Trained policies: folders of plain numbers and text, which numpy alone reads and runs."""

from magworm_gym.policy.folder import load_policy, policies, save_policy
from magworm_gym.policy.mistake import PolicyError
from magworm_gym.policy.network import Layer, Network, Normaliser
from magworm_gym.policy.policy import Policy

__all__ = [
    "Layer",
    "Network",
    "Normaliser",
    "Policy",
    "PolicyError",
    "load_policy",
    "policies",
    "save_policy",
]
